"""A campaign with a real column that is assessed: the worked example, and a few synthetic ground motions."""

import shutil
from pathlib import Path

import numpy as np

EXAMPLE = Path(__file__).resolve().parents[2] / "raw_schema" / "examples" / "delimited"

ASSESSED = """\
[prototype.prism]
restitution = "identified"
restitution_range = [0.85, 0.95]
friction = 0.6

[assessments.site]
specimen = "prism"
scale = 20
records = "records"
hazard = "hazard.csv"
levels = ["0.5 m/s", "1 m/s", "1.5 m/s", "2.5 m/s", "4 m/s"]
measures = ["pga", "pgv"]
draws = 2
resamples = 200

"""

COUNT, RATE, DURATION = 8, 50.0, 8.0


def ground_motion(seed):
    """Acceleration that starts and ends at rest without drift: the second derivative of a tapered displacement."""
    random, time = np.random.default_rng(seed), np.arange(int(RATE * DURATION)) / RATE
    frequency = 0.4 * np.exp(random.normal(0.0, 0.3))
    taper = np.sin(np.pi * time / DURATION) ** 4
    waves = sum(
        np.sin(2 * np.pi * frequency * n * time + random.uniform(0, 2 * np.pi)) * random.normal() / n**2
        for n in (1, 2, 3)
    )
    acceleration = np.gradient(np.gradient(taper * waves, time), time)
    return 3.0 * acceleration / np.abs(acceleration).max()


def write_assessed(folder):
    """Write the campaign; one of its records cannot be read."""
    shutil.copytree(EXAMPLE, folder, dirs_exist_ok=True)
    (folder / "records").mkdir()
    time = np.arange(int(RATE * DURATION)) / RATE
    for seed in range(COUNT):
        rows = np.column_stack((time, ground_motion(seed)))
        head = "time [s],acceleration [m/s^2]"
        np.savetxt(folder / "records" / f"r{seed}.csv", rows, delimiter=",", header=head, comments="", fmt="%.8g")
    (folder / "records" / "broken.csv").write_text("nothing\n", encoding="utf-8")
    (folder / "hazard.csv").write_text("pgv [cm/s], rate [1/year]\n5,0.02\n30,0.002\n300,3e-6\n", encoding="utf-8")
    file = folder / "campaign.toml"
    file.write_text(file.read_text(encoding="utf-8").replace("[[tests]]", ASSESSED + "[[tests]]", 1), encoding="utf-8")
    return folder
