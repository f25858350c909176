"""The pins of the command shaper block in the Python reference. Not for: what they are called in C or ST."""

from __future__ import annotations

from typing import Any, NamedTuple


class ShaperInput(NamedTuple):
    """Inputs of one tick.

    Parameters
    ----------
    command : float or int
        Wanted speed, in the units of the drive. Clamped to the maximum; non-finite counts as 0.
    selector : int
        Row: 0 unshaped, 1 to n.
    enable : bool
        False wants row 0.
    quick_stop, emergency_stop : bool
        Stop on the quick-stop ramp, unshaped; reference 0 at once.
    rope_length, hoist_speed : float or int
        The measured quantity (`measured`) and its change: rope length in m and m/s, positive when the load
        sinks, or position of an arm in m or rad; in int32 thousandths. Read by blocks that measure one only.
    rope_length_valid : bool
        False: the measured quantity is not to be believed.
    step_forward, step_reverse : bool
        Rising edges are steps; one counts only after the input was seen False. Read, like all that follow, by
        blocks with that function only (`operator_settings`).
    step_size : int
        Which of the three sizes, 1 to 3.
    stop_forward, stop_reverse : bool
        True: the stop switch at that end of the travel is made.
    slow_forward, slow_reverse : bool
        True: the slow-down switch before that end is made.
    distance_forward, distance_reverse : float or int
        Way left to each end of the travel, measured at the beginning of the tick: m, in int32 mm.
    distance_valid : bool
        False: the distances are not to be believed.
    drive_ready : bool
        False: the drive does not follow the reference.
    actual_speed : float or int
        Speed of the drive, in the units of the command.
    speed_limit : float or int
        Largest command from now on, 0 to the maximum, in the units of the command.
    rope_offset : float or int
        Added to the measured rope length: m, in int32 mm.
    """

    command: Any = 0
    selector: int = 1
    enable: bool = True
    quick_stop: bool = False
    emergency_stop: bool = False
    rope_length: Any = 0
    hoist_speed: Any = 0
    rope_length_valid: bool = True
    step_forward: bool = False
    step_reverse: bool = False
    step_size: int = 1
    stop_forward: bool = False
    stop_reverse: bool = False
    slow_forward: bool = False
    slow_reverse: bool = False
    distance_forward: Any = 0
    distance_reverse: Any = 0
    distance_valid: bool = True
    drive_ready: bool = True
    actual_speed: Any = 0
    speed_limit: Any = 0
    rope_offset: Any = 0


class ShaperOutput(NamedTuple):
    """Outputs of one tick; the fields of the generated block.

    Parameters
    ----------
    reference : float or int
        Speed for the drive, in its units.
    stop_distance : float or int
        Signed distance still to be travelled if the command were 0 from the next tick on: m, in int32 mm.
        Steps that are not yet travelled are part of it.
    stop_time_s : float or int
        Time until the reference is 0 then, in int32 rounded up to whole seconds. While steps run: what a
        release would take, less than the steps do.
    stop_time_ticks : int
        The same, in ticks; in int32 the last references may round to 0 before.
    residual_bound : float or int
        Residual vibration promised by the row in use: a ratio, in int32 millionths.
    row : int
        Row in use.
    settled : bool
        Nothing is pending: the reference equals the command and a row may change.
    active : bool
        The command is being shaped.
    error : bool
        An input cannot be right; the status says which.
    status : int
        The status word, bits as in :class:`~swayless.controller.status.Status`.
    predicted_sway : float or int
        Where the load hangs as the tick begins, by the linear model: m, in int32 mm, ahead of the trolley.
        0 in blocks without a model (`sway`).
    design_id : int
        Which design the block runs, 32 bits; 0 in blocks without design facts (`diagnostics`).
    """

    reference: Any
    stop_distance: Any
    stop_time_s: Any
    stop_time_ticks: int
    residual_bound: Any
    row: int
    settled: bool
    active: bool
    error: bool
    status: int
    predicted_sway: Any = 0
    design_id: int = 0
