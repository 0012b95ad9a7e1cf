"""The cheapest model for each tolerance, by restitution and loss."""

import re
from collections.abc import Sequence
from typing import Any

from stronge1994.tables import Row

MODEL = re.compile(r"model_(\d+)")


def cases(rows: Sequence[Row]) -> list[dict[str, Any]]:
    """Rows of results/which_model.csv by restitution and loss.

    Numbers stay text. `spread` and `spread_stick` are those of the answer under uncertain inputs;
    `batches` are how many impacts are solved together. Each of `rows` has an answer for each batch,
    and the `largest` and the `least` of the tolerances that follow each other and have these
    answers.

    >>> row = {"restitution [1]": "1.0", "loss": "", "tolerance [mu v2(0)]": "0.3"}
    >>> row |= dict.fromkeys(["other_loss [mu v2(0)]", "input_spread [mu v2(0)]"], "")
    >>> row |= {"input_spread_stick [mu v2(0)]": "", "model_1": "lumped"}
    >>> row |= {"max_velocity_1 [mu v2(0)]": "0.2", "whole_time_1 [s]": "1e-4"}
    >>> (answer,) = cases([row, row | {"tolerance [mu v2(0)]": "0.25"}])[0]["rows"]
    >>> answer["largest"], answer["least"], answer["answers"]["1"]
    ('0.3', '0.25', {'model': 'lumped', 'error': '0.2', 'time': '1e-4'})
    """
    by_contact: dict[tuple[str, str], dict[str, Any]] = {}
    for row in rows:
        batches = [match[1] for match in map(MODEL.fullmatch, row) if match]
        case = by_contact.setdefault(
            (row["restitution [1]"], row["loss"]),
            {
                "restitution": row["restitution [1]"],
                "loss": row["loss"],
                "other_loss": row["other_loss [mu v2(0)]"],
                "spread": row["input_spread [mu v2(0)]"],
                "spread_stick": row["input_spread_stick [mu v2(0)]"],
                "batches": batches,
                "rows": [],
            },
        )
        answers = {
            batch: {
                "model": row[f"model_{batch}"],
                "error": row[f"max_velocity_{batch} [mu v2(0)]"],
                "time": row[f"whole_time_{batch} [s]"],
            }
            for batch in batches
        }
        tolerance = row["tolerance [mu v2(0)]"]
        if not case["rows"] or case["rows"][-1]["answers"] != answers:
            case["rows"].append({"largest": tolerance, "answers": answers})
        case["rows"][-1]["least"] = tolerance
    return list(by_contact.values())
