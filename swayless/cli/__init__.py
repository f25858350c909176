"""The command line: one file per command. Everything else is imported inside the commands that need it."""
