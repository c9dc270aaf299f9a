"""Entry of `python -m reedpost`."""

import sys

from reedpost.cli import main

sys.exit(main())
