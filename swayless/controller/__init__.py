"""What runs on the machine, tick by tick, as the Python reference. Knows nothing of text or files."""

from swayless.controller.command_shaper import CommandShaper
from swayless.controller.limits import CommandLimits, SpeedLimits, command_limits
from swayless.controller.number import NUMBER_TYPES, NumberType, number_type
from swayless.controller.operator_options import OperatorOptions, operator_settings
from swayless.controller.operator_settings import OperatorSettings
from swayless.controller.pins import ShaperInput, ShaperOutput
from swayless.controller.settings import ShaperSettings
from swayless.controller.status import Status, explain
from swayless.controller.taps import Bank, Row, Taps, quantised_taps, shaped

__all__ = [
    "Bank",
    "CommandLimits",
    "CommandShaper",
    "NUMBER_TYPES",
    "NumberType",
    "OperatorOptions",
    "OperatorSettings",
    "Row",
    "ShaperInput",
    "ShaperOutput",
    "ShaperSettings",
    "SpeedLimits",
    "Status",
    "Taps",
    "command_limits",
    "explain",
    "number_type",
    "operator_settings",
    "quantised_taps",
    "shaped",
]
