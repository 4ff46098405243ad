"""What a sweep ends with: a table of its runs, and curves where they say something."""

import pandas as pd

from tribo.study.sweeping.summary import draw_runs


def table(loads, contacts):
    rows = [(load, contact) for contact in contacts for load in loads]
    return pd.DataFrame(
        {
            "run": range(1, len(rows) + 1),
            "status": "done",
            "load.normal_N": [load for load, _ in rows],
            "contact.type": [contact for _, contact in rows],
            "time_s": 60.0,
            "max_pressure_Pa": [1e7 * load for load, _ in rows],
            "bodies.ball.max_wear_depth_m": [1e-7 * load for load, _ in rows],
            "bodies.disk.max_wear_depth_m": 0.0,
        }
    )


def test_worn_bodies_are_drawn_of_plans_and_of_samples(tmp_path):
    drawn = draw_runs(table([20.0, 40.0], ["dcfft", "winkler"]), tmp_path)
    assert [path.name for path in drawn] == ["ball_depth.png"]
    sampled = table([float(load) for load in range(20, 28)], ["dcfft"])
    sampled.insert(3, "bodies.ball.wear.k_1_Pa", [1e-16 * (i + 1) for i in range(8)])
    assert [path.name for path in draw_runs(sampled, tmp_path)] == ["ball_depth.png"]
    assert draw_runs(sampled.assign(status="failed"), tmp_path) == []
