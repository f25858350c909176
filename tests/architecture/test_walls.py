"""The walls of the house, read from the imports: data flows one way, heavy packages stay in their rooms."""

import ast
import re
import subprocess
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).parents[2] / "swayless"

MAY_IMPORT = {
    "errors": set(),
    "plant": {"errors"},
    "design": {"errors", "plant"},
    "controller": {"errors", "plant", "design"},
    "codegen": {"errors", "plant", "design", "controller"},
    "verify": {"errors", "plant", "design", "controller", "codegen"},
    "machine": {"errors", "plant", "design", "controller"},
    "report": {"errors", "plant", "design", "controller"},
    "cli": {"errors", "plant", "design", "controller", "codegen", "verify", "machine", "report"},
}

ONLY_IN = {
    "typer": {"cli"},
    "rich": {"cli"},
    "matplotlib": {"report", "cli"},
    "jinja2": {"codegen"},
    "subprocess": {"verify"},
    "scipy": {"plant", "design"},
}

MODULES = sorted(path for path in PACKAGE.rglob("*.py"))


def room_of(path: Path) -> str:
    return path.relative_to(PACKAGE).parts[0].removesuffix(".py")


def imports_of(path: Path) -> set[str]:
    """Every module that a file imports, at the top or inside a function, but not for types only."""
    found = set()
    for node in ast.walk(without_type_checking(ast.parse(path.read_text(encoding="utf-8")))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            assert node.level == 0, f"{path}: relative import"
            found.add(node.module or "")
    return found


def without_type_checking(tree: ast.Module) -> ast.Module:
    tree.body = [
        node
        for node in tree.body
        if not (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
    ]
    return tree


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_rooms_import_one_way(path):
    room = room_of(path)
    if room == "__main__":
        room = "cli"  # one line that starts it
    if room == "__init__":
        assert not {name for name in imports_of(path) if name.startswith("swayless")}
        return
    rooms = {name.split(".")[1] for name in imports_of(path) if name.startswith("swayless.")}
    assert rooms - {room} <= MAY_IMPORT[room]


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_heavy_packages_stay_in_their_rooms(path):
    tops = {name.split(".")[0] for name in imports_of(path)}
    for package, rooms in ONLY_IN.items():
        assert package not in tops or room_of(path) in rooms, package


@pytest.mark.parametrize("path", MODULES, ids=lambda path: str(path.relative_to(PACKAGE)))
def test_every_module_says_what_it_is_for(path):
    assert ast.get_docstring(ast.parse(path.read_text(encoding="utf-8")))


def test_every_room_is_known():
    rooms = {path.name for path in PACKAGE.iterdir() if (path / "__init__.py").exists()}
    assert rooms == set(MAY_IMPORT) - {"errors"}


def test_no_room_is_a_dumping_ground():
    assert not [p for p in MODULES if re.search(r"(^|_)(utils?|common|helpers?|misc)(_|$)", p.stem)]


def test_help_imports_nothing_heavy():
    code = (
        "import sys, swayless.cli.app; "
        "print(sorted({'numpy', 'scipy', 'matplotlib', 'jinja2', 'rich'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


TEMPLATES = sorted((PACKAGE / "templates").rglob("*.j2"))


@pytest.mark.parametrize("path", TEMPLATES, ids=lambda path: path.name)
def test_templates_lay_out_text_and_compute_nothing(path):
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    assert len(lines) <= 150
    for expression in re.findall(r"{{(.*?)}}|{%(.*?)%}", text):
        code = "".join(expression)
        assert not re.search(r"[-+*/]\s|\|", re.sub(r'"[^"]*"', "", code)), code
