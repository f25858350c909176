"""Several axes in one machine file: what they share stands once, what is an axis's own in ``[axis.NAME]``.

Each axis is a machine of its own: the file without its axes, with what the axis says put in its place.

Not for: what the keys mean; every axis is read as a machine file is.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from swayless.machine.problems import Place, Report, nearest, shown

MAX_AXES = 4
_WHOLE_FILE = ("name", "axis")


def axis_documents(document: Mapping[str, object], report: Report) -> dict[str, dict[str, object]]:
    """Split the document of a machine file with axes into one document for each.

    Parameters
    ----------
    document : mapping
        The parsed file.
    report : Report
        Where problems of the sections ``[axis.NAME]`` themselves go.

    Returns
    -------
    dict
        By the axis's name; its machine is called by the file's name, an underscore and the axis's. Empty for
        a file without axes.

    Examples
    --------
    >>> own = {"bridge": {}, "trolley": {"crane": {"max_speed": 0.5}}}
    >>> file = {"name": "yard", "crane": {"max_speed": 1.0}, "axis": own}
    >>> axes = axis_documents(file, Report("yard.toml"))
    >>> axes["bridge"]["name"], axes["bridge"]["crane"], axes["trolley"]["crane"]
    ('yard_bridge', {'max_speed': 1.0}, {'max_speed': 0.5})
    """
    axes = document.get("axis", {})
    if not isinstance(axes, dict) or not all(isinstance(own, dict) for own in axes.values()):
        Place(report, "axis").wrong(axes, "must be sections [axis.NAME], one for each axis")
        return {}
    if "axis" in document and not 1 <= len(axes) <= MAX_AXES:
        Place(report, "axis").problem(f"{len(axes)} axes: 1 to {MAX_AXES} are allowed")
        return {}
    shared = {key: value for key, value in document.items() if key != "axis"}
    return {axis: _with_own(shared, axis, own, report) for axis, own in axes.items()}


def _with_own(
    shared: Mapping[str, object], axis: str, own: Mapping[str, object], report: Report
) -> dict[str, object]:
    """Put what an axis says into what all axes share: a section key by key, everything else as a whole."""
    merged = dict(shared)
    for key, value in own.items():
        common = shared.get(key)
        if key in _WHOLE_FILE:
            Place(report, f"[axis.{axis}] {key}").wrong(value, "stands once in the file, outside of the axes")
        elif isinstance(value, dict) and isinstance(common, dict):
            merged[key] = common | value
        else:
            merged[key] = value
    if isinstance(shared.get("name"), str):
        merged["name"] = f"{shared['name']}_{axis}"
    return merged


def chosen_axis(axes: Sequence[str], axis: str | None, report: Report) -> None:
    """Report an axis that the file has not, or that nobody chose."""
    if axis is None and axes:
        Place(report, "axis").problem(f"the file has axes {', '.join(axes)}: choose one with --axis")
    elif axis is not None and axis not in axes:
        why = nearest(axis, axes) if axes else "the file has none"
        Place(report, "axis").problem(f"no axis {shown(axis)}: {why}")


def merged_problems(
    found: Mapping[str, Sequence[str]], document: Mapping[str, object], file: str
) -> list[str]:
    """Give the problems of all axes: those that all have once, the others with the section of their axis.

    Parameters
    ----------
    found : mapping
        Problems by axis.
    document : mapping
        The parsed file.
    file : str
        What the user called it; every problem begins with it.

    Examples
    --------
    >>> file = {"axis": {"bridge": {}, "trolley": {"crane": {"max_speed": 0}}}}
    >>> merged_problems({
    ...     "bridge": ["y.toml: [crane] tick: missing"],
    ...     "trolley": ["y.toml: [crane] max_speed = 0: must be > 0", "y.toml: [crane] tick: missing"],
    ... }, file, "y.toml")
    ['y.toml: [crane] tick: missing', 'y.toml: [axis.trolley.crane] max_speed = 0: must be > 0']
    """
    everywhere = set.intersection(*(set(lines) for lines in found.values())) if found else set()
    problems: dict[str, None] = {}
    for axis, lines in found.items():
        for line in lines:
            kept = line in everywhere and not _is_own(line.removeprefix(f"{file}: "), axis, document)
            problems[line if kept else _within_axis(line, axis, file)] = None
    return list(problems)


def _is_own(problem: str, axis: str, document: Mapping[str, object]) -> bool:
    """Whether a problem is of a key that the axis itself gives."""
    axes = document["axis"]
    own = axes[axis] if isinstance(axes, dict) else {}
    starts = [
        f"[{section}] {key}" if isinstance(keys, dict) else f"[[{section}]]"
        for section, keys in own.items()
        for key in (keys if isinstance(keys, dict) else ("",))
    ]
    return problem.startswith(tuple(starts))


def _within_axis(line: str, axis: str, file: str) -> str:
    """Name the axis's own section in the place of the shared one."""
    problem = line.removeprefix(f"{file}: ")
    brackets = "[[" if problem.startswith("[[") else "["
    if not problem.startswith("["):
        return f"{file}: [axis.{axis}] {problem}"
    return f"{file}: {brackets}axis.{axis}.{problem.removeprefix(brackets)}"
