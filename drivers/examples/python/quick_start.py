# %% [markdown]
# One valve: a case, many cases, and steps under the pressure of a chamber. Run it as a script, or cell by cell.

# %%
import numpy as np
import reedvalve

valve = reedvalve.Valve()
print(f"reedvalve {reedvalve.__version__}, model {valve['run.model']}, gap {valve['film.gap_mm']} mm")

# %% [markdown]
# A case under its own pressures: a square wave of 20 kPa, opening at once and closing from 19.5 ms on.

# %%
valve["film.gap_mm"] = 0.03
valve["run.traces"] = True
case = valve.run()
print(
    f"Open by {case.steady_mm:.4f} mm, closed in {case.closing_ms:.1f} ms, peak film force {case.peak_squeeze_n:.4f} N"
)
print(f"{len(case.traces)} histories of {len(case.traces['time_ms'])} samples: {', '.join(case.traces)}")

# %% [markdown]
# Many cases side by side: every pressure with every gap.

# %%
gaps, pressures = np.array([0.03, 0.05, 0.1, 0.2]), np.array([10.0, 20.0, 40.0])
sweep = valve.sweep(reedvalve.product({"pressure.inlet_kpa": pressures, "film.gap_mm": gaps}))
print("closing time [ms] at gaps of", *(f"{gap:7.2f}" for gap in gaps), "mm")
for pressure, times in zip(pressures, sweep.grid("closing_ms")):
    print(f"{pressure:20.0f} kPa     ", *(f"{time:7.2f}" for time in times))

# %% [markdown]
# Steps under the pressure of another program: a piston drives oil into a chamber, the valve lets it out. In every step
# of 20 us the chamber takes the opening from the valve, and the valve the pressure from the chamber.

# %%
stiffness = 0.7e9 / 20e-6  # bulk modulus over volume of the chamber [Pa/m3]
conductance = 0.65 * np.pi * 4e-3 * np.sqrt(2 / 875.0)  # flow = conductance * opening * sqrt(pressure)
dt, pressure = 20e-6, 0.0
history = [(0.0, 0.0, 0.0)]
valve["pressure.inlet_kpa"] = 30.0  # about what the chamber reaches, for the tolerance
valve.begin()
for k in range(1, 1001):
    piston = 5e-6 * np.sin(np.pi * min(1.0, (k * dt) / 10e-3))  # flow [m3/s], over after 10 ms
    a = dt * stiffness * conductance * max(valve.displacement, 0.0)
    b = pressure + dt * stiffness * piston
    before, pressure = pressure, (0.5 * (np.sqrt(a * a + 4 * max(b, 0.0)) - a)) ** 2  # implicit Euler
    valve.step(k * dt, (before, pressure))
    history.append((1e3 * k * dt, 1e-3 * pressure, 1e3 * valve.displacement))
time, inlet, tip = np.array(history).T
print(f"Chamber: up to {inlet.max():.1f} kPa; reed: up to {tip.max():.4f} mm, {tip[-1]:.4f} mm after {time[-1]:.0f} ms")

# %% [markdown]
# Back to a kept state: what follows has the same bits.

# %%
kept = valve.state()
ends = []
for _ in range(2):
    valve.restore(kept)
    valve.step(25e-3, 0.0)
    ends.append(valve.displacement)
print(f"The same bits: {ends[0] == ends[1]}")

# %% [markdown]
# Pictures, where Matplotlib is installed: quick_start.png.

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None
if plt is not None:
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.5), layout="constrained")
    axes[0].plot(case.traces["time_ms"], case.traces["displacement_mm"])
    axes[0].set(title="One case", xlabel="time [ms]", ylabel="tip displacement [mm]")
    for pressure, times in zip(pressures, sweep.grid("closing_ms")):
        axes[1].semilogy(gaps, times, "o-", label=f"{pressure:.0f} kPa")
    axes[1].set(title="Twelve cases", xticks=gaps, xlabel="gap [mm]", ylabel="closing time [ms]")
    axes[1].legend()
    axes[2].plot(time, inlet, label="chamber [kPa]")
    axes[2].plot(time, 100 * tip, label="tip [0.01 mm]")
    axes[2].set(title="In a plant", xlabel="time [ms]")
    axes[2].legend()
    figure.savefig("quick_start.png", dpi=100)
