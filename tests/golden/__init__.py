"""Golden files: what the command line makes of every example, byte for byte."""
