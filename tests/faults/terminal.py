"""Run a command with a terminal of so many columns as its standard error: terminal.py COLUMNS FILE COMMAND...

FILE gets all that the terminal was sent, byte by byte. The exit status is that of the command.
"""

import fcntl
import os
import pty
import struct
import subprocess
import sys
import termios
from pathlib import Path


def main(columns: str, path: str, *command: str) -> int:
    """Run the command; its status."""
    ours, theirs = pty.openpty()
    fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, int(columns), 0, 0))
    with subprocess.Popen(command, stderr=theirs) as process, Path(path).open("wb") as sent:
        os.close(theirs)
        try:
            while chunk := os.read(ours, 65536):
                sent.write(chunk)
        except OSError:  # Linux ends a terminal that nobody holds open any more so
            pass
    return process.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
