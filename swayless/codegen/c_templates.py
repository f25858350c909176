"""Which templates make the source of a C block, and in which order. Not for: what they print."""

from __future__ import annotations

from swayless.codegen.features import Features


def source_templates(features: Features, filters: list[str], *, is_integer: bool) -> list[str]:
    """List the templates of the source after its constants: what is called stands before what calls it.

    Parameters
    ----------
    features : Features
        Parts of the law in use.
    filters : list of str
        Templates of the taps and the rope.
    is_integer : bool
        Whether the number type is int32.
    """
    glide = "glide_int32" if is_integer else "glide_float"
    has_approach = features.has_approach
    parts = (
        *(("clamped_reading", features.has_feedback or features.is_tuned), ("tuning", features.is_tuned)),
        *(("drive", features.has_feedback), ("switches", features.has_switches)),
        *(("contactor", features.has_contactor), ("command", True), ("ramp", True)),
        *((glide, has_approach), ("approach", has_approach), ("planned_move", features.has_plan)),
        *(("ends", features.has_way), ("travel", features.has_way)),
        *(("step_mode", features.has_steps), ("step_motion", features.has_steps)),
        *(("motion", True), ("next", has_approach), ("move", True), (glide, not has_approach)),
        *(("foretell", True), ("tracking", features.has_tracking)),
        ("tick_quanta", features.has_sway_rope and not features.has_phase_clock),
        *(("sway", features.has_sway), ("rope_bound", features.has_rope_bounds)),
        *(("checksum", features.has_facts), ("tick", True), ("calls", True)),
    )
    chosen = [f"c/{name}.c.j2" for name, is_used in parts if is_used]
    return [*_number_templates(features, is_integer=is_integer), *filters, *chosen]


def _number_templates(features: Features, *, is_integer: bool) -> list[str]:
    """List what others call; the rope and the phase clock bring some of it."""
    reads = features.has_feedback or features.is_tuned
    sums = features.has_way or features.has_sway
    parts = (
        ("is_number", not features.has_rope and not is_integer and (reads or features.has_way)),
        ("within", not features.has_rope and (reads or (sums and not is_integer))),
        ("sum_within", sums and is_integer and not features.has_phase_clock),
    )
    return [f"c/{name}.c.j2" for name, is_used in parts if is_used]
