"""Reading the namelist text of a result file."""

from __future__ import annotations

import pytest
from reedpost.namelist import flat_values, read_groups

TEXT = """\
&run title = 'it''s / a "valve"', model = 'traditional', 'squeeze', traces = .true. ! a remark = 1
  t_end_ms = 4.0d1 /
&film gap_mm = 5.0E-2 /
&sweep key = 'film.gap_mm', values = 0.05, 0.10 /
&sweep key = 'pressure.inlet_kpa', from = 5, to = 40, count = 8 /
"""


def test_groups_keep_order_and_repeat():
    assert [name for name, _ in read_groups(TEXT)] == ["run", "film", "sweep", "sweep"]
    assert read_groups(TEXT)[2][1]["values"] == [0.05, 0.10]


def test_values_have_their_kind():
    values = flat_values(TEXT)
    assert values["run.title"] == 'it\'s / a "valve"'
    assert values["run.model"] == ["traditional", "squeeze"]
    assert values["run.traces"] is True
    assert values["run.t_end_ms"] == 40.0
    assert values["film.gap_mm"] == 0.05


def test_sweeps_are_no_values():
    assert not any(key.startswith("sweep.") for key in flat_values(TEXT))


def test_nan_is_a_number():
    value = flat_values("&reed action_area_mm2 = NaN /")["reed.action_area_mm2"]
    assert value != value


def test_other_text_is_refused():
    with pytest.raises(ValueError, match="not a namelist"):
        read_groups("&run title = 'never closed /")
