"""Stepping under the caller's pressures, states, threads, and memory."""

from __future__ import annotations

import gc
import math
import pickle
import resource
import sys
import threading
import tracemalloc

import numpy as np
import pytest

import reedvalve as rv

DT = 50e-6  # [s]


def square_wave(t: float) -> float:
    """Inlet pressure of the default deck [Pa]: begins half way up, goes down from 19.5 to 20.5 ms."""
    return 20e3 * min(1.0, 0.5 + t / 1e-3, max(0.0, (20.5e-3 - t) / 1e-3))


@pytest.mark.parametrize("model", ["squeeze", "film_table"])
def test_steps_give_the_whole_case(model: str) -> None:
    """Trace of the same pressures, within ten tolerances of the steady displacement."""
    valve = rv.Valve(run_model=model, run_traces=True, run_trace_dt_ms=1e3 * DT, run_t_end_ms=24.0)
    whole = valve.run()
    valve.begin()
    found = [valve.displacement]
    for k in range(480):
        valve.step(DT * (k + 1), (square_wave(DT * k), square_wave(DT * (k + 1))))
        found.append(valve.displacement)
    trace = 1e-3 * whole.traces["displacement_mm"]
    assert np.abs(np.array(found) - trace).max() < 10 * valve["solver.rtol"] * trace.max()
    assert valve.time == DT * 480
    assert valve.velocity == pytest.approx(whole.traces["velocity_mm_ms"][-1], abs=1e-5)
    assert (valve.inlet, valve.outlet) == (square_wave(DT * 480), 0.0)
    assert math.isnan(valve.leakage) == (model == "squeeze")


def test_outputs_of_film_models() -> None:
    """All are there, and have the signs of a valve that opens."""
    valve = rv.Valve(run_model="film", film_modes=2)
    valve.begin(1.0)
    assert math.isnan(valve.inlet)
    valve.step(1.0 + 5e-4, (0.0, 20e3), p_out=(0.0, 1e3))
    assert valve.outlet == 1e3
    assert valve.velocity > 0.0
    assert valve.film_force < 0.0
    assert valve.film_low < 0.0
    assert valve.part_c > 0.0
    assert all(map(math.isfinite, (valve.part_a, valve.part_b, valve.leakage)))
    q, v = valve.coordinates
    assert q.shape == v.shape == (2,)


def test_state_leads_to_the_same_bits() -> None:
    """In this valve, in a pickled one, and in another of the same settings."""
    valve = rv.Valve(film_gap_mm=0.03)
    valve.begin()
    valve.step(1e-3, (0.0, 20e3))
    kept, there = valve.state(), pickle.dumps(valve)

    def go_on(valve: rv.Valve) -> list[float]:
        valve.step(2e-3, 20e3)
        return [valve.displacement, valve.velocity, valve.film_force]

    first = go_on(valve)
    valve.restore(kept)
    assert valve.time == 1e-3
    assert go_on(valve) == first
    other = pickle.loads(there)
    assert other.time == 1e-3
    assert go_on(other) == first
    third = rv.Valve(film_gap_mm=0.03)
    third.begin()
    third.restore(bytearray(kept))
    assert go_on(third) == first


def test_wrong_steps() -> None:
    """Each is refused with its reason and changes nothing."""
    valve = rv.Valve()
    assert not valve.is_stepping
    for call in (lambda: valve.time, lambda: valve.displacement, valve.state, lambda: valve.restore(b""),
                 lambda: valve.step(1.0, 1.0), lambda: valve.coordinates):  # fmt: skip
        with pytest.raises(rv.BadInputError, match="there is no state: begin first, after all settings"):
            call()
    valve.begin()
    assert valve.is_stepping
    before = valve.state()
    for words, message in (((0.0, 1.0), "time must go on"), ((1e-3, math.nan), "must be finite numbers"),
                           ((1e-3, (1.0, 2.0, 3.0)), "a pressure is a number or a pair of numbers, not"),
                           ((1e-3, "high"), "a pressure is a number or a pair of numbers, not 'high'")):  # fmt: skip
        with pytest.raises(rv.BadInputError, match=message):
            valve.step(*words)
    with pytest.raises(rv.BadInputError, match=r"a state of this valve has \d+ bytes: \d+ numbers of 8"):
        valve.restore(b"short")
    with pytest.raises(TypeError):
        valve.restore(32)
    assert valve.state() == before
    with pytest.raises(rv.BadInputError, match="the time to begin at must be a finite number"):
        valve.begin(math.inf)
    valve.begin()
    valve["film.gap_mm"] = 0.03
    assert not valve.is_stepping


def test_step_that_fails() -> None:
    """Only a restored state leads on."""
    valve = rv.Valve(solver_max_steps=20)
    valve.begin()
    kept = valve.state()
    with pytest.raises(rv.NotConvergedError):
        valve.step(1.0, (0.0, 20e3))
    with pytest.raises(rv.BadInputError, match="the last step failed"):
        valve.step(2.0, 20e3)
    valve.restore(kept)
    valve.step(1e-5, 20e3)


def in_threads(count: int, work) -> None:
    """Run work(i) in so many threads at once; their exceptions are this one's."""
    troubles: list[BaseException] = []

    def guarded(i: int) -> None:
        try:
            work(i)
        except BaseException as trouble:
            troubles.append(trouble)

    threads = [threading.Thread(target=guarded, args=(i,)) for i in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not troubles


def test_valves_in_threads() -> None:
    """Each its own: the bits of each alone, and its own messages."""
    gaps = [0.03, 0.05, 0.07, 0.09]
    alone = [rv.Valve(film_gap_mm=gap).run().closing_ms for gap in gaps]

    def work(i: int) -> None:
        for _ in range(5):
            valve = rv.Valve(film_gap_mm=gaps[i])
            assert valve.run().closing_ms == alone[i]
            with pytest.raises(rv.BadInputError, match=f"case 1: film.gap_mm = -{i + 1}: must be"):
                valve.sweep({"film.gap_mm": [-i - 1.0]})

    in_threads(4, work)


def test_one_valve_in_threads() -> None:
    """Calls wait for each other: no message and no result is another thread's."""
    valve = rv.Valve()
    expected = valve.run().closing_ms

    def work(i: int) -> None:
        for _ in range(300):
            if i == 3:
                assert valve.run().closing_ms == expected
            else:
                with pytest.raises(rv.BadInputError, match=f"film.gap_mm = -{i + 1}:"):
                    valve["film.gap_mm"] = -i - 1.0

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)  # threads change within calls
    try:
        in_threads(4, work)
    finally:
        sys.setswitchinterval(interval)


def test_lock_of_the_interpreter_is_free_meanwhile() -> None:
    """Another thread counts on while a sweep runs."""
    ticks, done = 0, threading.Event()

    def sweep() -> None:
        rv.Valve().sweep({"film.gap_mm": np.linspace(0.05, 0.3, 20000)}, threads=1)
        done.set()

    thread = threading.Thread(target=sweep)
    thread.start()
    while not done.wait(1e-3):
        ticks += 1
    thread.join()
    assert ticks >= 5  # the sweep takes 0.1 s at least


def test_memory_is_given_back() -> None:
    """Of valves that are closed, dropped, fail to be made, or end in an exception; with states and traces."""

    def use(n: int) -> None:
        for _ in range(n):
            valve = rv.Valve(run_traces=True, run_t_end_ms=25.0)
            valve.begin()
            valve.step(1e-4, 1e3)
            valve.run()
            with rv.Valve(run_t_end_ms=20.0) as other, pytest.raises(rv.BadInputError):
                other["film.gap_mm"] = -1.0
            with pytest.raises(rv.BadInputError):
                rv.Valve(film_gap_mm=-1.0)
            with pytest.raises(rv.FileError):
                rv.Valve("nowhere.nml")

    use(40)
    gc.collect()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    tracemalloc.start()
    use(5)
    gc.collect()
    traced = tracemalloc.get_traced_memory()[0]
    use(200)
    gc.collect()
    assert tracemalloc.get_traced_memory()[0] - traced < 50_000  # 200 valves of 250 bytes
    tracemalloc.stop()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 8000  # kB; a lost valve keeps its traces: 200 of them 20 MB
