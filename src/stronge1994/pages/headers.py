"""Headers of the report's tables: a description of each column, with its unit."""

import re

# Descriptions of columns whose names a reader would not understand.
HEADERS = {
    "rms_velocity": "root mean square error of the velocity at separation",
    "max_velocity": "largest error of the velocity at separation",
    "rms_peak_friction": "root mean square error of the largest friction",
    "max_peak_friction": "largest error of the largest friction",
    "rms_dissipation": "root mean square error of the work of friction",
    "max_dissipation": "largest error of the work of friction",
    "seen": "share of incidences with an error above the uncertainty from the inputs",
    "reference_error": "error of the reference",
    "input_spread": "uncertainty from the inputs, all impacts",
    "input_spread_stick": "uncertainty from the inputs, impacts that stick at first",
    "time": "time of an impact in the batch",
    "busy": "how many times too long, as the machine was busy",
    "tolerance": "tolerance asked for",
    "steps": "time steps in a contact",
    "circles": "circles of contact",
    "build_time": "time to compile",
    "batch": "impacts in the batch",
    "time_alone": "time of an impact alone",
    "times_compiled": "over the time of the compiled continuum",
    "times_spheres": "over the time of the table of spheres",
    "restitution": "restitution e",
    "name": "model and setting",
    "incidence": "incidence v1(0)/(mu v2(0))",
    "mass_ratio": "mass ratio m2/m1",
    "stiffness_ratio": "stiffness ratio zeta^2",
    "omega": "frequency ratio omega/Omega",
    "phases": "phases of stick and slip in a contact",
    "quantity": "parameter",
    "digits_median": "correct digits, median",
    "digits_allowed_median": "digits that the condition allows, median",
    "digits_least": "correct digits, least",
    "digits_allowed_least": "digits that the condition allows, least",
    "digits_lost_most": "digits lost beyond the condition, most",
    "all_points": "all published points beside the curve, smallest distance caught",
    "zeta^2": "smallest change of zeta^2 caught, share of zeta^2",
    "beta": "smallest change of m2/m1 caught, share of m2/m1",
    "e": "smallest change of e caught",
    "mu": "smallest change of mu caught, share of mu",
}
# Columns that exist for several batches.
BATCHES = {
    "time": "time of an impact in a batch of {}",
    "busy": "how many times too long, as the machine was busy, in a batch of {}",
}
SPELLED = {"us": "µs"}
# Units that are left out: the description names what is counted, or the ratio itself.
WITHOUT = {"1", "unit of quantity"}
RATIOS = {"incidence", "omega"}
BATCH = re.compile(r"(time|busy)_(\d+)")


def header(column: str) -> str:
    """Description of a column, with its unit after a comma.

    >>> header("max_velocity [mu v2(0)]")
    'largest error of the velocity at separation, mu v2(0)'
    >>> header("time_1000 [s]"), header("time_1 [s]")
    ('time of an impact in a batch of 1000, s', 'time of an impact in a batch of 1, s')
    >>> header("incidence [mu v2(0)]"), header("young_modulus [Pa]")
    ('incidence v1(0)/(mu v2(0))', 'young modulus, Pa')
    """
    name, _, unit = column.rstrip("]").partition(" [")
    batch = BATCH.fullmatch(name)
    plain = (
        BATCHES[batch[1]].format(batch[2]) if batch else HEADERS.get(name, name.replace("_", " "))
    )
    return (
        plain
        if not unit or unit in WITHOUT or name in RATIOS
        else f"{plain}, {SPELLED.get(unit, unit)}"
    )
