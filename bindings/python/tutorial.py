# %% [markdown]
# # EHL Explorer from Python
#
# A tour in cells (`# %%`): run it as a script, or open it as a notebook in an editor that supports such cells.
# All quantities are in SI units; X = x/a, P = p/p_H and H = h R/a² are dimensionless.

# %%
import numpy as np

import ehl_explorer as ehl

# %% [markdown]
# ## One contact
#
# A contact is given by Moes numbers, in SI units, or as engineers write it. It is immutable; `replace` returns a new one.

# %%
contact = ehl.Contact.moes(40, 10)
roller = ehl.Contact.engineering(
    radius="12 mm", speed="3 m/s", load="300 N/mm", modulus="231 GPa", oil="ISO VG 68", temperature="60 °C", srr="5 %"
)
print(roller, f"M = {roller.m:.1f}, L = {roller.l:.1f}, p_H = {roller.hertz_pressure / 1e9:.2f} GPa")

# %% [markdown]
# The full solver takes milliseconds to seconds, the reduced model a fraction of a millisecond. The reduced model reports
# whether the contact is inside its trained range, and a 99 % empirical error bound relative to a full solution on its own
# grid. The discretisation error of this grid is the same for both solutions. A full solution contains an estimate of it.

# %%
full = ehl.solve(contact.replace(grid="model"))
fast = ehl.solve(contact, method="reduced")
reduction = abs(fast.H_c / full.H_c - 1)
discretisation = full["grid.truncation_error"] + full["grid.resolution_error"]
print(f"full    H_c = {full.H_c:.6f}, h_c = {full.h_c_m * 1e9:.1f} nm, error of its grid {discretisation:.1e}")
print(f"reduced H_c = {fast.H_c:.6f}, trained: {fast.trained}, error {reduction:.1e}, below {fast.h_c_error_bound:.1e}")
assert reduction < fast.h_c_error_bound
assert full.pressure.shape == full.film.shape == full.x.shape

# %% [markdown]
# On another grid, the full solution differs by the discretisation errors of both grids. They are much larger than the
# error of the reduced model.

# %%
usual = ehl.solve(contact)
of_usual = usual["grid.truncation_error"] + usual["grid.resolution_error"]
print(f"on {usual['grid.nx']} nodes H_c = {usual.H_c:.6f}, {abs(usual.H_c / full.H_c - 1):.1e} from the other grid, error {of_usual:.1e}")
assert abs(usual.H_c / full.H_c - 1) < 2 * (of_usual + discretisation)

# %% [markdown]
# An invalid contact is refused with one sentence.

# %%
try:
    ehl.Contact.moes(40, float("nan"))
except ehl.EhlError as refused:
    print(refused)

# %% [markdown]
# ## Many contacts
#
# Arrays of contacts are solved on all cores into a structured array. A row that cannot be solved contains the reason and
# does not affect the others.

# %%
loads = np.geomspace(1e5, 4e5, 40)
speeds = np.array([[1.0], [2.0], [4.0]])
base = ehl.Contact.si(radius=0.012, speed=1, load=1e5, modulus=231e9, viscosity=0.02, alpha=20e-9)
films = ehl.solve_many(base, load=loads, speed=speeds, method="reduced")
print(films.shape, films.dtype.names)
print("status:", set(films["status"].flat), "reasons:", set(films["reason"].flat))
print("h_c in nm:", np.round(films["h_c_m"][:, 0] * 1e9, 1), "trained:", bool(films["reduced.trained"].all()))

# %% [markdown]
# In a sweep, each contact starts from its neighbour, as on the command line.

# %%
table = ehl.sweep(contact, "moes-m=10:160:5:log", method="reduced")
print(np.column_stack([table["moes.M"], table["H_c"]]))

# %% [markdown]
# ## A transient contact
#
# The load oscillates by 10 %; times are in units of a/u_m. If a step fails, `MarchStopped` is raised; its `reached`
# contains the rows computed so far.

# %%
time = np.linspace(0, 4, 81)
march = ehl.transient(contact, duration=4, step=0.05, load=(time, 1 + 0.1 * np.sin(2 * np.pi * time / 2)))
print(march.dtype.names, march["H_c"].min(), march["H_c"].max())

# %% [markdown]
# ## Scenes
#
# A scene is an experiment with expected values, given as a file or a text.

# %%
scene = """Scene(
    version: 1,
    title: "Two methods, one contact",
    at: Moes(m: 40.0, l: 10.0),
    grid: Model,
    study: Point(methods: [Full, Reduced(model: Embedded)]),
    expect: [(name: "H_c_error", method: Reduced(model: Embedded), within: AtMost(1e-3))],
)"""
outcome = ehl.run(scene, progress=lambda stage, done, total: None)
print(outcome, outcome.expectations, list(outcome.tables))

# %% [markdown]
# ## Pictures

# %%
try:
    import matplotlib.pyplot as plt
except ImportError:
    plt = None

if plt:
    figure, axes = plt.subplots()
    axes.plot(full.x, full.pressure, label="P, full")
    axes.plot(fast.x, fast.pressure, "--", label="P, reduced")
    axes.plot(full.x, full.film, label="H, full")
    axes.set(xlim=(-2, 1.5), ylim=(0, 1.5), xlabel="X = x/a")
    axes.legend()
    plt.show()
