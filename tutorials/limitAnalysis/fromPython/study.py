# Copyright 2026 the Drystone authors. SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # A panel of masonry from Python
# How does the load that a panel carries depend on friction, how does it fail, and what happens beyond? Each `# %%` is a
# cell: Jupyter (through jupytext), Spyder and VS Code show this file as a notebook; `python3 study.py` runs it as a whole.
# Figures are drawn where matplotlib is installed.

# %%
import pathlib

import drystone

panel = drystone.Case("panel")
panel.run("blockTexture")

# %% [markdown]
# ## Friction
# One copy of the case for each coefficient; `set` changes an entry of a dictionary and keeps its comments.

# %%
coefficients = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.65, 0.7, 0.8, 0.9, 1.0]
multipliers = []
for mu in coefficients:
    case = panel.copy(f"runs/mu{mu}", replace=True)
    case.set("constant/contactProperties", "friction/mu", mu)
    case.run("limitAnalysis")
    multipliers.append(float(case.table("limitAnalysis")["alpha"][0]))

rows = [f"{mu:g} {alpha:.9g}" for mu, alpha in zip(coefficients, multipliers)]
pathlib.Path("runs/friction.dat").write_text("\n".join(["# mu[-] alpha[-]", *rows, ""]), encoding="utf-8")
print("mu    alpha", *rows, sep="\n")

# %% [markdown]
# With little friction the panel slides, and alpha is mu; with more it breaks and overturns. The paper has mu = 0.65.

# %% [markdown]
# ## Mechanism and motion
# The frames of a mechanism, then those of the motion when the ground accelerates by 1.1 times what the panel carries.

# %%
mechanism = list(drystone.Case("runs/mu0.65").frames())[-1]
panel.run("contactDynamics")
motion = list(panel.frames())
energy = panel.table("energy")
print(f"after {motion[-1].time:g} s a block has moved by {motion[-1].largestDisplacement():.3f} m,")
print(f"kinetic energy {energy['kinetic'][-1]:.1f} J, lost by friction {energy['frictionLoss'][-1]:.1f} J")

# %% [markdown]
# ## Figures

# %%
try:
    import matplotlib
except ImportError:
    print("matplotlib is not installed: no figures")
    raise SystemExit(0)
matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "drystone", "font.size": 9})
import matplotlib.pyplot as plt


def drawBlocks(axes, frame, title):
    """The blocks of a frame where they are; those that are fixed grey."""
    for polygon, support in zip(frame.polygons, frame["support"]):
        x, y = zip(*(frame.points[i][:2] for i in polygon))
        axes.fill(x, y, facecolor="0.75" if support >= 0 else "#d9a066", edgecolor="black", linewidth=0.5)
    axes.set(title=title, aspect="equal", xlim=(-0.5, 3.2), ylim=(-0.1, 1.3), xlabel="x [m]", ylabel="y [m]")


figure, ((overFriction, overTime), (fails, moves)) = plt.subplots(2, 2, figsize=(9, 6), layout="constrained")
overFriction.plot(coefficients, multipliers, "o-", label="limitAnalysis")
overFriction.plot([0, 1], [0, 1], "k:", label="alpha = mu: sliding")
overFriction.set(title="Collapse multiplier over friction", xlabel="mu [-]", ylabel="alpha [-]", xlim=(0, 1.05), ylim=(0, 1.05))
overFriction.legend()
for name, label in (("kinetic", "kinetic"), ("potential", "potential"), ("frictionLoss", "lost by friction")):
    overTime.plot(energy["Time"], energy[name], label=label)
overTime.set(title="Energy at 1.1 alpha", xlabel="time [s]", ylabel="energy [J]")
overTime.legend()
drawBlocks(fails, mechanism, "Mechanism, mu = 0.65")
drawBlocks(moves, motion[-1], f"Motion after {motion[-1].time:g} s")
figure.savefig("runs/study.svg", metadata={"Date": None})
print("wrote runs/study.svg")
