"""The paper's arithmetic: each statement of the example, checked."""

import pytest


def test_a_step_holds_no_whole_number_of_strokes(example):
    motion = example.motion()
    assert motion.speed == pytest.approx(0.1)
    assert motion.distance == pytest.approx(360.0)
    assert motion.strokes == pytest.approx(180_000)
    assert motion.steps == pytest.approx(14_400)
    assert motion.distance_per_step == pytest.approx(0.025)
    assert motion.strokes_per_step == pytest.approx(12.5)
    assert motion.cycles_per_step == pytest.approx(6.25)


def test_the_printed_coefficient_needs_25_times_the_distance(example):
    k = example.wear_coefficients()
    assert k.from_distance == pytest.approx(7.785e-15, rel=1e-4, abs=0)
    # The paper prints three digits, 3.11e-16; the weights give 3.114e-16.
    assert k.from_multiplied_distance == pytest.approx(example.WEAR_COEFFICIENT, rel=2e-3, abs=0)
    assert k.ball == pytest.approx(7.08e-15, rel=1e-3, abs=0)
    assert k.disk == pytest.approx(7.08e-16, rel=1e-3, abs=0)


def test_neither_reading_of_equal_reaches_the_weighed_volume(example):
    each, half = example.readings()
    assert each.per_body == pytest.approx(1.12e-11, rel=1e-3, abs=0)
    assert each.total == pytest.approx(2 * half.total, rel=1e-12, abs=0)
    assert 1 / each.of_weighed == pytest.approx(12.5, rel=3e-3)
    assert 1 / half.of_weighed == pytest.approx(25.0, rel=3e-3)
    # 0.088 mg off each body, 23 times less than the ball lost.
    assert each.per_body * example.DENSITY * 1e6 == pytest.approx(0.088, abs=5e-4)


def test_the_weighed_loss_is_a_cap_wider_than_the_image(example):
    cap = example.flat_cap()
    # πh²(3R − h)/3 = 2.0 mg / 7850 kg/m³, solved apart; the shallow form gives 1.128 mm.
    assert cap.radius == pytest.approx(1.124e-3, abs=5e-7)
    assert cap.depth == pytest.approx(128e-6, abs=5e-7)
    assert 2 * cap.radius > max(example.IMAGE)


def test_the_weighed_split_leaves_the_crown_the_paper_shows(example):
    split = example.weighed_split()
    assert split.worn.flat_depth[0] == pytest.approx(9.26e-6, abs=5e-9)
    assert split.along == pytest.approx(2.23e-3, abs=5e-6)
    assert split.across == pytest.approx(2.31e-3, abs=5e-6)
    assert split.stroke_needed > 2 * example.STROKE


def test_main_prints_the_report(example, capsys):
    example.main()
    printed = capsys.readouterr().out
    assert "12.5: the paper asks for a whole number" in printed
    assert printed.rstrip("\n") == example.report()
