"""The menu of everyday commands, in the environment that is active: `nox -s NAME`."""

import nox

nox.options.default_venv_backend = "none"
nox.options.sessions = ["lint", "types", "test"]


@nox.session
def lint(session: nox.Session) -> None:
    """Check style and format."""
    session.run("ruff", "check", ".")
    session.run("ruff", "format", "--check", ".")


@nox.session
def types(session: nox.Session) -> None:
    """Check types, strictly."""
    session.run("mypy")


@nox.session
def test(session: nox.Session) -> None:
    """Run all tests."""
    session.run("python", "-m", "pytest", "--quiet", "--numprocesses", "2", *session.posargs)


@nox.session
def golden(session: nox.Session) -> None:
    """Make the golden files again; look at the diff before you commit it."""
    session.run("python", "-m", "tests.golden.update")


@nox.session
def bench(session: nox.Session) -> None:
    """Time everything beside its peers."""
    session.run("python", "-m", "benchmarks")
