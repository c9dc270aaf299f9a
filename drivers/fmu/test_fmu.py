"""FMUs as an importer sees them: FMPy validates them, and what FMI promises is tried one after the other."""

from __future__ import annotations

import ctypes
import os
import re
import shutil
import stat
import subprocess
import sys
import threading
import zipfile
from pathlib import Path

import netCDF4
import numpy as np
import pytest

fmpy = pytest.importorskip("fmpy")
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE  # noqa: E402
from fmpy.fmi3 import FMU3Slave, fmi3LogMessageCallback  # noqa: E402
from fmpy.validation import validate_fmu  # noqa: E402

HERE = Path(__file__).parent
BUILD = HERE.parents[1] / "build" / "release" / "drivers" / "reedvalve" / "reedvalve"
PROGRAM = Path(os.environ.get("REEDVALVE", BUILD))
RTOL = 1e-6
STEP = 5e-5  # [s]
WAVE = "&pressure kind = 'square', inlet_kpa = 20.0, period_ms = 6.0, transition_ms = 0.5 /\n"
MODELS = ["traditional", "squeeze", "film", "film_table"]

pytestmark = pytest.mark.skipif(
    not (PROGRAM.parent / "fmu" / "reedvalve.so").exists(), reason="this program was built without FMUs"
)


def reedvalve(*words: object, status: int = 0) -> str:
    """Run the program; what it says."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == status, done.stderr
    return done.stdout + done.stderr


def deck_of(model: str) -> str:
    return f"&run model = '{model}', t_end_ms = 6.0, traces = .true., trace_dt_ms = 0.05 /\n{WAVE}"


def pack(folder: Path, deck: str, fmi: int, name: str = "valve") -> Path:
    (folder / f"{name}.nml").write_text(deck)
    reedvalve("fmu", folder / f"{name}.nml", "-o", folder / f"{name}.fmu", "--fmi", fmi, "--quiet")
    return folder / f"{name}.fmu"


class FMU2SlaveAs3(FMU2Slave):
    """FMI 2.0 with the names that FMPy has for 3.0."""

    getFloat64, setFloat64 = FMU2Slave.getReal, FMU2Slave.setReal
    getInt32, setInt32 = FMU2Slave.getInteger, FMU2Slave.setInteger
    getInt64, setInt64 = getInt32, setInt32
    enterEventMode = FMU2Slave.cancelStep
    fmi3GetFMUState = FMU2Slave.fmi2GetFMUstate

    def instantiate(self, loggingOn: bool, logMessage: object) -> None:
        def log(environment: object, name: bytes, status: int, category: bytes, message: bytes) -> None:
            logMessage(environment, status, category, name + b": " + message % ())

        callbacks = fmi2CallbackFunctions(logger=fmi2CallbackLoggerTYPE(log))
        super().instantiate(callbacks=callbacks, loggingOn=loggingOn)

    def enterInitializationMode(
        self, tolerance: float | None = None, startTime: float = 0.0, stopTime: float | None = None
    ) -> None:
        self.setupExperiment(tolerance, startTime, stopTime)
        super().enterInitializationMode()


class Valve:
    """One instance of an unpacked FMU, its variables by name, and what it has logged."""

    def __init__(self, folder: Path, name: str = "valve", logging: bool = True) -> None:
        description = fmpy.read_model_description(str(folder))
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.messages: list[str] = []
        slave = FMU2SlaveAs3 if description.fmiVersion == "2.0" else FMU3Slave
        self.fmu = slave(
            guid=description.guid, unzipDirectory=str(folder), modelIdentifier="reedvalve", instanceName=name
        )
        self.fmu.instantiate(loggingOn=logging, logMessage=self.log)

    def log(self, environment: object, status: int, category: bytes, message: bytes) -> None:
        self.messages.append(f"{category.decode()} {message.decode()}")

    def time(self) -> float:
        if isinstance(self.fmu, FMU2Slave):
            return self.fmu.getRealStatus(fmpy.fmi2.fmi2LastSuccessfulTime)
        return self.get("time")[0]

    def set(self, **values: float) -> None:
        for name, value in values.items():
            self.fmu.setFloat64([self.reference[name.replace("__", ".")]], [value])

    def get(self, *names: str) -> list[float]:
        return self.fmu.getFloat64([self.reference[name] for name in names])

    def initialize(self, **values: float) -> None:
        self.set(**values)
        self.fmu.enterInitializationMode(startTime=0.0)
        self.fmu.exitInitializationMode()

    def drive(self, steps: int, first: int = 0) -> bytes:
        """Steps under pressures that go up and down; the bits of all outputs."""
        seen = []
        for k in range(first, first + steps):
            self.set(p_in=2e4 * np.sin(0.1 * k) ** 2, p_in_rate=1e6)
            self.fmu.doStep(k * STEP, STEP)
            seen.append(self.get("displacement", "velocity", "film_force"))
        return np.array(seen).tobytes()

    def close(self) -> None:
        self.fmu.freeInstance()


@pytest.fixture(scope="module", params=[2, 3])
def fmi(request: pytest.FixtureRequest) -> int:
    return request.param


only_2 = pytest.mark.parametrize("fmi", [2], indirect=True)
only_3 = pytest.mark.parametrize("fmi", [3], indirect=True)


@pytest.fixture(scope="module")
def packed(fmi: int, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("fmu")
    return {model: pack(folder, deck_of(model), fmi, model) for model in MODELS}


@pytest.fixture(scope="module")
def unpacked(packed: dict[str, Path]) -> dict[str, Path]:
    folders = {}
    for model, file in packed.items():
        folders[model] = file.with_suffix("")
        shutil.unpack_archive(file, folders[model], "zip")
    return folders


@pytest.fixture
def valve(unpacked: dict[str, Path]) -> Valve:
    one = Valve(unpacked["squeeze"])
    yield one
    one.close()


@pytest.mark.parametrize("model", MODELS)
def test_valid(packed: dict[str, Path], model: str) -> None:
    assert validate_fmu(str(packed[model])) == []


def test_description(packed: dict[str, Path]) -> None:
    """Every key that can change is there, with the deck's value, unit and range."""
    by_name = {v.name: v for v in fmpy.read_model_description(str(packed["film_table"])).modelVariables}
    gap = by_name["film.gap_mm"]
    assert (gap.unit, float(gap.start), float(gap.min), gap.variability) == ("mm", 0.05, 0.0, "fixed")
    assert {"reed.poisson_ratio", "film.mesh", "film_low", "leakage", "hydro.load"} <= set(by_name)
    assert not {"reed.k_a", "film.k_s", "run.t_end_ms"} & set(by_name)


@only_2
def test_same_variables(packed: dict[str, Path], tmp_path: Path) -> None:
    """FMI 2.0 and 3.0 tell the same of all but the time, which 2.0 leaves out."""
    said = {}
    type_of = {"Real": "Float64", "Integer": "Int32"}
    for model in MODELS:
        other = pack(tmp_path, deck_of(model), 3, model)
        for fmi, file in ((2, packed[model]), (3, other)):
            description = fmpy.read_model_description(str(file))
            said[fmi] = {
                v.name: [v.valueReference, v.causality, v.variability, v.unit, v.min, v.max, v.start, v.description]
                + [type_of.get(v.type, v.type)]
                + [[(item.name, item.value) for item in v.declaredType.items] if v.declaredType else None]
                for v in description.modelVariables
            }
            for unknowns in (description.outputs, description.initialUnknowns):
                assert [u.variable.name for u in unknowns] == [
                    v.name for v in description.modelVariables if v.causality == "output"
                ]
        assert said[3].pop("time")[1] == "independent"
        assert said[2] == said[3] and len(said[2]) > 20


@only_2
def test_same_bits(unpacked: dict[str, Path], tmp_path: Path) -> None:
    """Steps are the same in FMI 2.0 and 3.0."""
    shutil.unpack_archive(pack(tmp_path, deck_of("film_table"), 3), tmp_path, "zip")
    done = []
    for folder in (unpacked["film_table"], tmp_path):
        valve = Valve(folder)
        valve.initialize(film__gap_mm=0.04)
        done.append(valve.drive(30))
        valve.close()
    assert done[0] == done[1]


def test_units(packed: dict[str, Path]) -> None:
    """Each unit is made of others as its name says, and every one is there that a variable has."""
    description = fmpy.read_model_description(str(packed["film"]))
    base = {unit.name: unit.baseUnit for unit in description.unitDefinitions}
    power = {name: np.array([int(getattr(unit, b) or 0) for b in ("kg", "m", "s")]) for name, unit in base.items()}
    factor = {name: float(unit.factor or 1) for name, unit in base.items()}
    expected = {
        "m": [0, 1, 0],
        "s": [0, 0, 1],
        "N": [1, 1, -2],
        "mm": power["m"],
        "ms": power["s"],
        "mm2": 2 * power["m"],
        "m/s": power["m"] - power["s"],
        "m3/s": 3 * power["m"] - power["s"],
        "Pa": power["N"] - 2 * power["m"],
        "kPa": power["Pa"],
        "GPa": power["Pa"],
        "Pa s": power["Pa"] + power["s"],
        "Pa/s": power["Pa"] - power["s"],
        "kg/m3": [1, -3, 0],
    }
    assert {name: list(value) for name, value in power.items()} == {name: list(v) for name, v in expected.items()}
    prefixed = {"mm": 1e-3, "ms": 1e-3, "mm2": 1e-6, "kPa": 1e3, "GPa": 1e9}
    assert factor == {name: prefixed.get(name, 1.0) for name in expected}
    assert {v.unit for v in description.modelVariables} - {None} <= set(expected)


@pytest.mark.parametrize("model", MODELS)
def test_same_as_the_program(packed: dict[str, Path], model: str) -> None:
    """Pressures are straight between the samples of the program's trace, so stepping agrees with it to ten of its own
    tolerances, as tests/api asks of steps of 50 us: of the largest displacement, and of that times the frequency for
    velocities. The film's force is that of velocity and gap, and is ten times as sensitive."""
    deck = packed[model].with_name(f"{model}_run.nml")
    deck.write_text(deck_of(model) + f"&solver rtol = {RTOL / 100} /\n")
    folder = packed[model].parent / f"{model}_run"
    reedvalve("run", deck, "-o", folder, "--quiet")
    with netCDF4.Dataset(folder / "results.nc") as results:
        names = ("displacement_mm", "velocity_mm_ms", "squeeze_n", "inlet_kpa")
        displacement, velocity, force, inlet = (np.array(results[name][0]) for name in names)
        time = 1e-3 * np.array(results["time_ms"][:])
        frequency = float(results["wet_frequency_hz"][0])
    rate = np.append(np.diff(1e3 * inlet) / np.diff(time), 0.0)
    columns = [("time", float), ("p_in", float), ("p_in_rate", float)]
    signals = np.array(list(zip(time, 1e3 * inlet, rate, strict=True)), dtype=columns)
    ours = fmpy.simulate_fmu(str(packed[model]), stop_time=time[-1], output_interval=STEP, input=signals)
    largest = 1e-3 * np.max(np.abs(displacement))
    assert np.allclose(ours["time"], time, atol=1e-9)
    assert np.max(np.abs(ours["displacement"] - 1e-3 * displacement)) <= 10 * RTOL * largest
    assert np.max(np.abs(ours["velocity"] - velocity)) <= 10 * RTOL * largest * 2 * np.pi * frequency
    assert np.max(np.abs(ours["film_force"] - force)[1:]) <= 100 * RTOL * np.max(np.abs(force))


def test_reset_runs_the_same(valve: Valve) -> None:
    valve.initialize(film__gap_mm=0.04)
    first = valve.drive(40)
    valve.fmu.reset()
    assert valve.get("film.gap_mm") == [0.05]
    valve.initialize(film__gap_mm=0.04)
    assert valve.drive(40) == first


def test_threads(unpacked: dict[str, Path]) -> None:
    """Instances side by side do what each does alone."""
    valves = [Valve(unpacked[model], model) for model in ("squeeze", "squeeze", "traditional", "film_table")]
    viscosities = [0.02, 0.04, 0.06, 0.08]
    alone = []
    for valve, viscosity in zip(valves, viscosities, strict=True):
        valve.initialize(fluid__viscosity_pa_s=viscosity)
        alone.append(valve.drive(60))
        valve.fmu.reset()
    together = [b""] * len(valves)

    def work(i: int) -> None:
        valves[i].initialize(fluid__viscosity_pa_s=viscosities[i])
        together[i] = valves[i].drive(60)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(valves))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone
    for valve in valves:
        valve.close()


@pytest.mark.parametrize("model", MODELS)
def test_state(unpacked: dict[str, Path], model: str) -> None:
    """Back to a state, in this instance, after a reset, and in another one that was never started: the same bits."""
    valve, other = Valve(unpacked[model]), Valve(unpacked[model], "other")
    valve.initialize(fluid__viscosity_pa_s=0.03)
    valve.drive(7)
    state = valve.fmu.getFMUState()
    ahead = valve.drive(9, first=7)
    valve.fmu.setFMUState(state)
    assert valve.time() == pytest.approx(7 * STEP, rel=1e-15)
    assert valve.drive(9, first=7) == ahead
    valve.fmu.reset()
    valve.fmu.setFMUState(state)
    assert valve.drive(9, first=7) == ahead
    kept = valve.fmu.serializeFMUState(state)
    valve.fmu.freeFMUState(state)
    other.fmu.setFMUState(other.fmu.deserializeFMUState(kept))
    assert other.get("fluid.viscosity_pa_s") == [0.03]
    assert other.drive(9, first=7) == ahead
    valve.close()
    other.close()


def test_state_is_whole(unpacked: dict[str, Path]) -> None:
    """Inputs, outputs, stop time and what has no value of its own come back; a handle that is used again is new."""
    valve, other = Valve(unpacked["squeeze"]), Valve(unpacked["squeeze"], "other")
    hole = np.pi / 4 * 4.0**2
    names = ("p_in", "p_out", "p_in_rate", "p_out_rate", "displacement", "velocity", "film_force")
    valve.fmu.enterInitializationMode(stopTime=4.5 * STEP)
    valve.fmu.exitInitializationMode()
    valve.drive(3)
    valve.set(p_in=1e4, p_out=2e3, p_in_rate=-1e6, p_out_rate=1e6)
    seen = valve.get(*names)
    state = valve.fmu.getFMUState()
    kept = valve.fmu.serializeFMUState(state)
    valve.fmu.doStep(3 * STEP, STEP)
    ahead = valve.get(*names)
    old = ctypes.c_void_p(state.value)
    valve.fmu.fmi3GetFMUState(valve.fmu.component, ctypes.byref(state))
    with pytest.raises(Exception, match="status 3"):
        valve.fmu.setFMUState(old)
    assert "this is no state of this instance" in valve.messages[-1]

    other.initialize(reed__action_area_mm2=10.0)
    other.fmu.setFMUState(other.fmu.deserializeFMUState(kept))
    assert other.get("reed.action_area_mm2") == pytest.approx([hole], rel=1e-15)
    assert other.get(*names) == seen
    other.fmu.doStep(3 * STEP, STEP)
    assert other.get(*names) == ahead
    with pytest.raises(Exception, match="status 3"):
        other.fmu.doStep(4 * STEP, STEP)
    assert "goes beyond stopTime" in other.messages[-1]
    other.fmu.reset()
    other.initialize()
    other.drive(6)
    valve.close()
    other.close()


def test_slopes(valve: Valve) -> None:
    """The squeeze model knows the difference of the pressures only."""
    valve.initialize(p_in=2e4, p_in_rate=-1e7)
    valve.fmu.doStep(0.0, 1e-3)
    falling = valve.get("displacement", "velocity")
    valve.fmu.reset()
    valve.initialize(p_in=2e4, p_out_rate=1e7)
    valve.fmu.doStep(0.0, 1e-3)
    assert valve.get("displacement", "velocity") == pytest.approx(falling, rel=1e-9)


def test_messages(unpacked: dict[str, Path]) -> None:
    """Warnings only for those who ask; # is FMI's mark of a variable and comes doubled."""
    for wanted, said in [([], 1), (["logStatusWarning"], 1), (["logStatusError"], 0)]:
        valve = Valve(unpacked["squeeze"], logging=False)
        valve.set(reed__thickness_mm=1.6e-4)
        assert valve.messages == []
        valve.fmu.setDebugLogging(True, wanted)
        valve.set(reed__thickness_mm=1.5e-4)
        assert len(valve.messages) == said
        assert all("unusually small for mm; was it given in m?" in message for message in valve.messages)
        with pytest.raises(Exception, match="status 3"):
            valve.fmu.setDebugLogging(True, ["#%d"])
        assert valve.messages[-1].endswith("there is no log category '##%d'")
        valve.close()


def test_whole_numbers(valve: Valve) -> None:
    """In FMI 2.0 whole numbers and choices are of one type, and come in one call."""
    names = ("film.acts", "solver.max_steps", "solver.method")
    references = [valve.reference[name] for name in names]
    if isinstance(valve.fmu, FMU2Slave):
        valve.fmu.setInteger(references, [2, 5000, 3])
        assert valve.fmu.getInteger(references) == [2, 5000, 3]
    else:
        valve.fmu.setInt64(references[::2], [2, 3])
        valve.fmu.setInt32(references[1:2], [5000])
        assert valve.fmu.getInt64(references[::2]) + valve.fmu.getInt32(references[1:2]) == [2, 3, 5000]


def test_damaged_state(valve: Valve, unpacked: dict[str, Path]) -> None:
    valve.initialize()
    kept = bytearray(valve.fmu.serializeFMUState(valve.fmu.getFMUState()))
    for place in (0, 9, len(kept) // 2, len(kept) - 1):
        kept[place] ^= 1
        with pytest.raises(Exception, match=r"(?i)DeserializeFMUState failed"):
            valve.fmu.deserializeFMUState(bytes(kept))
        kept[place] ^= 1
    assert "no state of this FMU, or are damaged" in valve.messages[-1]


REFUSED = [
    (lambda v: v.set(film__gap_mm=-1.0), "film.gap_mm = -1: must be >= 0 (mm)"),
    (lambda v: v.set(film__gap_mm=1e300), "film.gap_mm = 1e300"),
    (lambda v: v.set(reed__thickness_mm=float("nan")), "reed.thickness_mm = NaN"),
    (lambda v: v.set(p_in=float("inf")), ": p_in must be a finite number"),
    (lambda v: v.set(p_out=float("nan")), ": p_out must be a finite number"),
    (lambda v: v.set(p_in_rate=float("nan")), ": p_in_rate must be a finite number"),
    (lambda v: v.set(p_out_rate=float("nan")), ": p_out_rate must be a finite number"),
    (lambda v: v.fmu.setFloat64([4711], [1.0]), "valueReference 4711"),
    (lambda v: v.fmu.getFloat64([4711]), "valueReference 4711"),
    (lambda v: v.fmu.setFloat64([v.reference["displacement"]], [1.0]), "no variable of this type that can be set has"),
    (lambda v: v.fmu.getInt32([v.reference["film.gap_mm"]]), ": no variable of this type has valueReference 1"),
    (lambda v: v.fmu.getFloat64([v.reference["film.acts"]]), ": no variable of this type has valueReference 1"),
    (lambda v: v.fmu.getBoolean([1]), "there is no variable of this type"),
    (lambda v: v.fmu.setInt64([v.reference["film.acts"]], [3]), "film.acts has no choice number 3"),
    (lambda v: v.fmu.setInt64([v.reference["film.acts"]] * 2, [1, 0]), "film.acts has no choice number 0"),
    (lambda v: v.fmu.setInt32([v.reference["solver.max_steps"]], [0]), "solver.max_steps = 0"),
    (lambda v: v.fmu.doStep(0.0, STEP), "not allowed while the instance is instantiated"),
    (lambda v: v.fmu.exitInitializationMode(), "not allowed while the instance is instantiated"),
    (lambda v: v.fmu.enterInitializationMode(startTime=float("nan")), "startTime is not a finite number"),
    (lambda v: v.fmu.enterInitializationMode(tolerance=2.0), "solver.rtol = 2"),
    (lambda v: v.fmu.enterEventMode(), "this FMU does not offer this function"),
    (lambda v: v.fmu.setDebugLogging(True, ["all"]), "there is no log category 'all'"),
]


@pytest.mark.parametrize("number", range(len(REFUSED)))
@pytest.mark.parametrize("logging", [True, False])
def test_refused(unpacked: dict[str, Path], fmi: int, number: int, logging: bool) -> None:
    """An error with a message, even where nobody asked for messages; then reset leads on."""
    call, words = REFUSED[number]
    valve = Valve(unpacked["squeeze"], logging=logging)
    with pytest.raises(Exception, match="status 3"):
        call(valve)
    assert words in valve.messages[-1] and valve.messages[-1].startswith(f"logStatusError valve: fmi{fmi}")
    valve.fmu.reset()
    valve.initialize()
    valve.drive(1)
    valve.close()


def test_refused_step(valve: Valve) -> None:
    valve.initialize()
    valve.drive(3)
    state = valve.fmu.getFMUState()
    for point, length, words in [
        (0.0, STEP, "time must not go backwards"),
        (1.0, STEP, "time must not jump"),
        (3 * STEP, 0.0, "longer than 0"),
        (3 * STEP, -STEP, "longer than 0"),
        (3 * STEP, 1e-300, "time must go on"),
        (3 * STEP, float("nan"), "finite"),
    ]:
        with pytest.raises(Exception, match="DoStep failed with status 3"):
            valve.fmu.doStep(point, length)
        assert words in valve.messages[-1]
        valve.fmu.setFMUState(state)
    with pytest.raises(Exception, match="status 3"):
        valve.set(film__gap_mm=0.04)
    assert "film.gap_mm is fixed when initialization mode is over" in valve.messages[-1]
    with pytest.raises(Exception, match="status 3"):
        valve.fmu.doStep(3 * STEP, STEP)
    assert "while the instance is terminated" in valve.messages[-1]
    valve.fmu.setFMUState(state)
    valve.drive(1, first=3)
    valve.fmu.terminate()
    with pytest.raises(Exception, match="status 3"):
        valve.fmu.doStep(4 * STEP, STEP)


def test_freed_twice(valve: Valve, unpacked: dict[str, Path], fmi: int) -> None:
    """While another instance keeps the library loaded, which FMPy would else unload."""
    freed = Valve(unpacked["squeeze"])
    stale = ctypes.c_void_p(freed.fmu.component)
    freed.close()
    valve.fmu.dll[f"fmi{fmi}FreeInstance"](stale)
    assert valve.fmu.dll[f"fmi{fmi}Terminate"](stale) == 3
    valve.initialize()


@only_3
def test_other_interfaces(unpacked: dict[str, Path]) -> None:
    """Model exchange, a wrong token, missing resources and a missing name: no instance, and a message."""
    valve = Valve(unpacked["squeeze"])
    log = fmi3LogMessageCallback(valve.log)
    resources = str(unpacked["squeeze"] / "resources").encode()
    make = valve.fmu.dll.fmi3InstantiateCoSimulation
    token = valve.fmu.guid.encode()
    for name, given, place, words in [
        (b"valve", b"{other}", resources, "the instantiation token (guid) is {other}"),
        (b"valve", token, b"/no/where", "cannot read '/no/where/valve.nml'"),
        (b"valve", token, None, "the path of the FMU's resources is missing"),
        (b" ", token, resources, "the instance needs a name"),
    ]:
        no_update = fmpy.fmi3.fmi3IntermediateUpdateCallback()
        assert not make(name, given, place, False, False, False, False, None, 0, None, log, no_update)
        assert words in valve.messages[-1]
    assert not valve.fmu.fmi3InstantiateModelExchange(b"valve", token, resources, False, False, None, log)
    assert "for co-simulation only" in valve.messages[-1]
    valve.close()


@only_2
def test_other_interfaces_2(unpacked: dict[str, Path]) -> None:
    """The same of FMI 2.0, whose resources are a URI."""
    valve = Valve(unpacked["squeeze"])
    odd = unpacked["squeeze"].parent / "100% ä"
    odd.mkdir()
    (odd / "valve.nml").write_bytes((unpacked["squeeze"] / "resources" / "valve.nml").read_bytes())

    def make(name: bytes, guid: bytes, place: str | None, model_exchange: bool = False) -> int | None:
        place = place.encode() if place is not None else None
        interface = fmpy.fmi2.fmi2ModelExchange if model_exchange else fmpy.fmi2.fmi2CoSimulation
        return valve.fmu.dll.fmi2Instantiate(name, interface, guid, place, ctypes.byref(valve.fmu.callbacks), 0, 0)

    guid, place = valve.fmu.guid.encode(), odd.as_uri()
    assert place.endswith("100%25%20%C3%A4")
    for start in ("file:", "FILE://", "file://localhost", "file:///"):
        instance = make(b"valve", guid, start + place.removeprefix("file://").replace("%C3", "%c3"))
        assert instance, valve.messages
        valve.fmu.dll.fmi2FreeInstance(ctypes.c_void_p(instance))
    bad = (str(odd), "file://elsewhere/path", "file:path", "http:///path", place + "%2", place + "%g0", place + "%00")
    for name, given, where, words in [
        (b"valve", b"{other}", place, "valve: fmi2Instantiate: the instantiation token (guid) is {other}"),
        (b"valve", guid, "file:///no/where%25", "cannot read '/no/where%/valve.nml'"),
        (b" ", guid, place, "the instance needs a name"),
        *((b"valve", guid, uri, f"must be a URI as file:///path, not '{uri}'") for uri in bad),
        (b"valve", guid, None, "must be a URI as file:///path, not 'NULL'"),
    ]:
        assert not make(name, given, where)
        assert words in valve.messages[-1]
    assert not make(b"valve", guid, place, model_exchange=True)
    assert "for co-simulation only" in valve.messages[-1]
    valve.close()


@only_2
def test_derivatives(valve: Valve) -> None:
    """A derivative of a pressure is its slope, whatever it is set by, and stays; there is none of a higher order."""
    rate, p_in = valve.reference["p_in_rate"], valve.reference["p_in"]
    seen = []
    for by_derivative in (True, False):
        valve.initialize(p_in=2e4, p_in_rate=4e6)
        if by_derivative:
            valve.fmu.setRealInputDerivatives([p_in], [1], [-1e7])
        else:
            valve.set(p_in_rate=-1e7)
        valve.fmu.doStep(0.0, STEP)
        valve.fmu.doStep(STEP, STEP)
        assert valve.get("p_in", "p_in_rate") == [2e4, -1e7]
        seen.append(valve.get("displacement", "velocity"))
        valve.fmu.reset()
    assert seen[0] == seen[1]
    valve.initialize()
    valve.fmu.setRealInputDerivatives([p_in, p_in + 1], [1, 1], [1.0, 2.0])
    valve.set(p_in_rate=3.0)
    assert valve.get("p_in_rate", "p_out_rate") == [3.0, 2.0]
    valve.fmu.setRealInputDerivatives([p_in, rate], [2, 1], [0.0, 0.0])
    assert valve.messages == []
    valve.fmu.setRealInputDerivatives([p_in, rate], [2, 1], [5.0, 5.0])
    assert [message.split(":")[0] for message in valve.messages] == ["logStatusWarning valve"] * 2
    assert valve.get("p_in_rate", "p_out_rate") == [3.0, 2.0]
    for reference, order, value, words in [
        (p_in, 0, 1.0, "there is no derivative of order 0"),
        (p_in, 1, float("nan"), "p_in_rate must be a finite number"),
        (valve.reference["displacement"], 1, 1.0, "only inputs have derivatives: valueReference 10"),
    ]:
        with pytest.raises(Exception, match="status 3"):
            valve.fmu.setRealInputDerivatives([reference], [order], [value])
        assert words in valve.messages[-1]
        valve.fmu.reset()


@only_2
def test_set_up(valve: Valve) -> None:
    """What fmi2SetupExperiment says is forgotten with a reset; its tolerance is the parameter's."""
    valve.fmu.setupExperiment(tolerance=1e-5, startTime=1.0, stopTime=1.0 + 2.5 * STEP)
    assert valve.get("solver.rtol") == [1e-5]
    valve.set(solver__rtol=1e-7)
    FMU2Slave.enterInitializationMode(valve.fmu)
    valve.fmu.exitInitializationMode()
    assert (valve.time(), valve.get("solver.rtol")) == (1.0, [1e-7])
    valve.fmu.doStep(1.0, 2 * STEP)
    with pytest.raises(Exception, match="status 3"):
        valve.fmu.doStep(1.0 + 2 * STEP, STEP)
    assert "goes beyond stopTime" in valve.messages[-1]
    valve.fmu.reset()
    FMU2Slave.enterInitializationMode(valve.fmu)
    valve.fmu.exitInitializationMode()
    assert valve.get("solver.rtol") == [1e-6]
    valve.drive(3)


@only_2
def test_status(valve: Valve) -> None:
    """Steps are done when they return: no other status, and no errors for asking."""
    valve.initialize()
    valve.drive(2)
    assert valve.fmu.getRealStatus(fmpy.fmi2.fmi2LastSuccessfulTime) == pytest.approx(2 * STEP, rel=1e-15)
    assert valve.fmu.getBooleanStatus(fmpy.fmi2.fmi2Terminated) is False
    for ask in ("getStatus", "getRealStatus", "getIntegerStatus", "getBooleanStatus", "getStringStatus"):
        with pytest.raises(Exception, match="status 2"):
            getattr(valve.fmu, ask)(fmpy.fmi2.fmi2DoStepStatus)
        assert f"fmi2{ask[0].upper()}{ask[1:]}: there is no such status" in valve.messages[-1]
    valve.drive(2, first=2)


def test_outputs_at_the_start(unpacked: dict[str, Path]) -> None:
    """At rest nothing has moved; from equilibrium the reed stands where its pressures hold it, and stays there."""
    valve = Valve(unpacked["squeeze"])
    valve.set(p_in=2e4)
    valve.fmu.enterInitializationMode()
    assert valve.get("displacement", "velocity") == [0.0, 0.0]
    valve.fmu.setInt64([valve.reference["run.start"]], [2])
    half = valve.get("displacement")[0]
    valve.set(p_in=4e4)
    start = valve.get("displacement")[0]
    assert start == pytest.approx(2 * half, rel=1e-3)
    valve.fmu.exitInitializationMode()
    valve.fmu.doStep(0.0, 1e-10)
    valve.fmu.doStep(1e-10, 1e-3)
    assert start > 5e-5 and abs(valve.get("displacement")[0] - start) < 10 * RTOL * start
    valve.close()


def test_another_importer(packed: dict[str, Path]) -> None:
    """Ecos, an importer in C++ with its own reader of FMUs, computes what FMPy does."""
    try:
        from ecospy import EcosParameterSet, EcosSimulation, EcosSimulationStructure
    except (ImportError, OSError) as missing:
        pytest.skip(f"Ecos cannot be loaded: {missing}")
    start = {"film.gap_mm": 0.04, "p_in": 2e4}
    structure, parameters = EcosSimulationStructure(), EcosParameterSet.EcosParameterSet()
    structure.add_model("valve", str(packed["film_table"]))
    for name, value in start.items():
        parameters.add_real(f"valve::{name}", value)
    structure.add_parameter_set("start", parameters)
    simulation = EcosSimulation(structure=structure, step_size=STEP)
    simulation.init(parameter_set="start")
    simulation.step(40)
    ours = fmpy.simulate_fmu(str(packed["film_table"]), stop_time=40 * STEP, output_interval=STEP, start_values=start)
    for name in ("displacement", "velocity", "film_low", "part_c_force"):
        assert simulation.get_real(f"valve::{name}") == pytest.approx(ours[name][-1], rel=1e-9)
    simulation.terminate()
    simulation.free()


@only_3
def test_library(unpacked: dict[str, Path]) -> None:
    """It exports FMI's functions and no other, and stands on the C library and what lies beside it."""
    folder = next((unpacked["squeeze"] / "binaries").iterdir())
    words = subprocess.run(["nm", "-D", "--defined-only", folder / "reedvalve.so"], capture_output=True, text=True)
    names = {line.split()[2] for line in words.stdout.splitlines()}
    headers = "".join(path.read_text() for path in Path(fmpy.__file__).parent.glob("c-code/fmi[23]Functions.h"))
    declared = set(re.findall(r"^ *FMI[23]_Export +\w+ +(\w+);", headers, re.M))
    assert names == declared and len(names) > 110
    words = subprocess.run(["ldd", "-r", folder / "reedvalve.so"], capture_output=True, text=True, env={})
    assert "undefined symbol" not in words.stdout + words.stderr
    for line in words.stdout.splitlines():
        name = line.split()[0]
        if name.startswith(("libgfortran", "libquadmath", "libgomp")):
            assert str(folder) in line
        else:
            assert name.split("/")[-1].split(".")[0].startswith(("linux-vdso", "libc", "libm", "libgcc_s", "ld-linux"))


@only_3
def test_elsewhere(packed: dict[str, Path], tmp_path: Path) -> None:
    """An FMU runs where no library of this project's needs can be loaded: here they are hidden."""
    hide = """
        names='lib(gfortran|quadmath|gomp|sundials|lapack|blas|netcdf|zip)'
        for file in $(/sbin/ldconfig -p | grep -E "$names" | awk '{print $NF}'); do
            mount --bind /dev/null "$(realpath "$file")"
        done
        exec "$@"
    """
    alone = ["unshare", "--mount", "sh", "-euc", hide, "sh"]
    if subprocess.run([*alone, "true"], capture_output=True).returncode != 0:
        pytest.skip("no mounts of one's own here")
    assert subprocess.run([*alone, PROGRAM, "--version"], capture_output=True).returncode != 0
    simulate = """
import sys, fmpy
result = fmpy.simulate_fmu(sys.argv[1], stop_time=1e-3, start_values={"p_in": 2e4})
print("open" if 1e-4 < result["displacement"][-1] < 2e-4 else "not open")
"""
    words = [*alone, sys.executable, "-c", simulate, packed["film_table"]]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == "open\n", done.stderr


def test_packing(tmp_path: Path) -> None:
    """The same bytes from the same deck; nothing is replaced or left behind unasked."""
    deck = tmp_path / "my.nml"
    deck.write_text("&run title = 'a & \"b\" <c>' /")
    said = reedvalve("fmu", deck, "-o", tmp_path / "my.fmu")
    assert said.endswith("my.fmu: 4 inputs, 3 outputs, 21 parameters.\n")
    assert "already" in reedvalve("fmu", deck, "-o", tmp_path / "my.fmu", status=2)
    assert "is not a file" in reedvalve("fmu", deck, "-o", tmp_path, "--force", status=2)
    assert "--fmi takes 2 or 3, not '1'" in reedvalve("fmu", deck, "--fmi", 1, status=2)
    assert "'--fmi' needs a value" in reedvalve("fmu", deck, "--fmi", status=2)
    for version in ("2", "3"):
        reedvalve("fmu", deck, "-o", tmp_path / "again.fmu", "--force", "--fmi", version)
        reedvalve("fmu", deck, "-o", tmp_path / "my.fmu", "--force", f"--fmi={version}")
        assert (tmp_path / "my.fmu").read_bytes() == (tmp_path / "again.fmu").read_bytes()
        entries = zipfile.ZipFile(tmp_path / "my.fmu").infolist()
        assert {entry.date_time for entry in entries} == {(1980, 1, 1, 0, 0, 0)}
        assert {stat.filemode(entry.external_attr >> 16) for entry in entries} == {"-rw-r--r--"}
        assert validate_fmu(str(tmp_path / "my.fmu")) == []
        assert fmpy.read_model_description(str(tmp_path / "my.fmu")).fmiVersion == f"{version}.0"
    deck.write_text("&run model = 'squeeze', 'film' /\n&sweep key = 'film.gap_mm', values = 0.1, 0.2 /")
    assert "an FMU is one case, these are 4" in reedvalve("fmu", deck, status=2)
    deck.write_text("&film gap_mm = -0.05 /")
    assert "must be >= 0" in reedvalve("fmu", deck, status=2)
    assert "there is no such file" in reedvalve("fmu", tmp_path / "none.nml", status=3)
    deck.write_text("&film gap_mm = 0.05 /")
    assert "no/my.fmu': No such file" in reedvalve("fmu", deck, "-o", tmp_path / "no" / "my.fmu", status=3)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["again.fmu", "my.fmu", "my.nml"]


def test_packing_by_the_program_of_mpi(tmp_path: Path) -> None:
    """The same bytes, in the build tree too."""
    program = Path(PROGRAM).parents[1] / "reedvalve_mpi" / "reedvalve_mpi"
    if not program.exists():
        pytest.skip("this build has no MPI")
    mine = pack(tmp_path, deck_of("squeeze"), 3)
    subprocess.run([program, "fmu", tmp_path / "valve.nml", "-o", tmp_path / "mpi.fmu"], check=True)
    assert (tmp_path / "mpi.fmu").read_bytes() == mine.read_bytes()


def test_trace(tmp_path: Path, fmi: int) -> None:
    """A deck with a measured trace takes it along, and starts from equilibrium."""
    (tmp_path / "p.csv").write_text("t_ms,p_diff_kpa\n0,5\n1,20\n2,20\n3,0\n")
    file = pack(tmp_path, "&pressure kind = 'trace', file = 'p.csv', event_ms = 2.0 /", fmi)
    assert validate_fmu(str(file)) == []
    assert "resources/trace.csv" in zipfile.ZipFile(file).namelist()
    names = {v.name for v in fmpy.read_model_description(str(file)).modelVariables}
    assert not {"pressure.inlet_kpa", "pressure.outlet_kpa"} & names
    (tmp_path / "p.csv").unlink()
    result = fmpy.simulate_fmu(str(file), stop_time=1e-3, output_interval=1e-4, start_values={"p_in": 5e3})
    assert abs(result["displacement"][-1] / result["displacement"][0] - 1) < 1e-5


PAGE = (HERE.parents[1] / "docs" / "fmu.md").read_text()


def test_page(tmp_path: Path) -> None:
    """The examples of the page say what is printed below them."""
    commands = re.search(r"```\n(\$.*?)```", PAGE, re.S).group(1).splitlines()
    said = []
    for line in commands:
        if line.startswith("$ "):
            where = {"PATH": f"{PROGRAM.parent}:{os.environ['PATH']}"}
            done = subprocess.run(line[2:], shell=True, cwd=tmp_path, env=where, capture_output=True, text=True)
            said += [line, *done.stdout.splitlines()]
    assert said == commands
    python, text = re.search(r"```python\n(.*?)```\n\n```text\n(.*?)```", PAGE, re.S).groups()
    done = subprocess.run([sys.executable, "-c", python], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout == text, done.stderr


@only_3
def test_page_of_variables(packed: dict[str, Path]) -> None:
    """The page's table is made of the model descriptions."""
    rows: dict[int, list[str]] = {}
    models: dict[int, list[str]] = {}
    for model, file in packed.items():
        for v in fmpy.read_model_description(str(file)).modelVariables:
            if v.causality == "independent":
                continue
            unit = v.unit or ""
            if v.declaredType is not None:
                unit = "one of " + ", ".join(item.name for item in v.declaredType.items)
            rows[int(v.valueReference)] = [f"`{v.name}`", v.causality, unit, v.description]
            models.setdefault(int(v.valueReference), []).append(model)
    lines = ["| variable | | unit | meaning | models |", "|---|---|---|---|---|"]
    for reference in sorted(rows):
        which = "all" if len(models[reference]) == len(MODELS) else ", ".join(models[reference])
        lines.append(f"| {' | '.join(rows[reference])} | {which} |")
    table = "\n".join(lines)
    assert f"\n\n{table}\n\n" in PAGE, f"docs/fmu.md must have this table:\n{table}"


def run_cosine(folder: Path, step: float, has_slopes: bool) -> np.ndarray:
    """Displacements every 0.2 ms under a pressure from 0 to 20 kPa and back in 2 ms."""
    valve = Valve(folder)
    valve.initialize(solver__rtol=1e-8)
    seen = []
    for k in range(round(4e-3 / step)):
        start, end = (1e4 * (1 - np.cos(np.pi * 1e3 * step * i)) for i in (k, k + 1))
        valve.set(p_in=start, p_in_rate=(end - start) / step if has_slopes else 0.0)
        valve.fmu.doStep(k * step, step)
        if (k + 1) % round(2e-4 / step) == 0:
            seen += valve.get("displacement")
    valve.close()
    return np.array(seen)


@only_3
def test_page_of_steps(unpacked: dict[str, Path]) -> None:
    """The page's errors, which fall with the first and the second order. The reference's own is 1e-6 of the motion."""
    reference = run_cosine(unpacked["squeeze"], 2e-6, True)
    rows = re.findall(r"\| (\d+) us \| (\S+) \| (\S+) \|", PAGE)
    assert len(rows) == 5
    for step, *errors in rows:
        for printed, has_slopes in zip(errors, (False, True), strict=True):
            error = run_cosine(unpacked["squeeze"], 1e-6 * float(step), has_slopes) - reference
            assert np.max(np.abs(error)) / np.max(np.abs(reference)) == pytest.approx(float(printed), rel=0.05)
