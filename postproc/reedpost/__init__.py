"""Tables, pictures and reports from reedvalve results, beside the published ones."""

__version__ = "0.1.0"
