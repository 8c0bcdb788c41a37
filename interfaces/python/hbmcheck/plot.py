"""Figures of results, where matplotlib is installed. Each draws into axes, new ones for None, and returns them."""
from __future__ import annotations

from typing import Any

import numpy as np

COLOURS = {"match": "tab:green", "differs": "tab:red", "unstable": "tab:orange", "other_branch": "tab:purple",
           "solver_failed": "tab:gray", "undecided": "tab:gray"}


def _axes(axes: Any) -> Any:
    if axes is not None:
        return axes
    try:
        import matplotlib.pyplot as plt
    except ImportError:
        raise ImportError("figures need matplotlib: apt install python3-matplotlib, or pip install matplotlib") from None
    return plt.subplots()[1]


def _labelled(axes: Any) -> Any:
    axes.set_xlabel("omega [rad/time]")
    axes.set_ylabel("amplitude [length]")
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return axes


def curve(points: Any, axes: Any = None) -> Any:
    """Amplitude over omega, where it is unstable dashed."""
    axes = _axes(axes)
    unstable = points.stable == "no"
    for drawn, style, label in ((~unstable, "-", "harmonic balance"), (unstable, "--", "unstable")):
        beside = drawn | np.roll(drawn, 1) & (np.arange(len(drawn)) > 0)  # lines meet where stability changes
        if drawn.any():
            axes.plot(points.omega, np.where(beside, points.amplitude, np.nan), style, color="tab:blue", label=label)
    return _labelled(axes)


def transient(rows: Any, axes: Any = None) -> Any:
    """Amplitudes over omega by verdict."""
    axes = _axes(axes)
    for verdict in np.unique(rows.verdict):
        which = rows.verdict == verdict
        axes.plot(rows.omega[which], rows.amplitude[which], "x", label=verdict)
    return _labelled(axes)


def comparison(rows: Any, axes: Any = None) -> Any:
    """Both sides' amplitudes over omega."""
    axes = _axes(axes)
    axes.plot(rows.omega, rows.hbm_amplitude, "o", mfc="none", label="harmonic balance")
    axes.plot(rows.omega, rows.transient_amplitude, "x", label="time integration")
    return _labelled(axes)


def verification(points: Any, axes: Any = None) -> Any:
    """The points by verdict, over the nearest solutions."""
    axes = _axes(axes)
    axes.plot(points.omega, points.nearest, ".", color="black", ms=3, label="nearest solution")
    for verdict in np.unique(points.verdict):
        which = points.verdict == verdict
        axes.plot(points.omega[which], points.value[which], "o", mfc="none", color=COLOURS.get(verdict), label=verdict)
    axes.set_title(points.cause)
    return _labelled(axes)
