"""What a sweep costs beside the solving, what it costs to go on with one that is done, and a data set's frames a second."""

from __future__ import annotations

import resource
import tempfile
import time

import tactile_net as tn

POINTS = 10_000


def processor_seconds() -> float:
    return sum(
        used.ru_utime + used.ru_stime
        for used in map(resource.getrusage, (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    )


smallest = tn.Scene(
    sensor=tn.Sensor(count=3, pitch=1.0, depth=1.0, reads=["stress_x"]),
    material=tn.Material(youngs_modulus=1.0, poisson_ratio=0.45),
    contacts=[tn.Cylinder(force=1.0, half_width=0.5)],
    reconstruct=tn.Reconstruct(alpha=1e-3),
)
study = tn.Study(smallest, {"contact.0.force": {"from": 0.5, "to": 1.5, "count": POINTS}})
with tempfile.TemporaryDirectory() as folder:
    before = processor_seconds()
    table = tn.sweep(study, f"{folder}/rows.csv")
    cost = (processor_seconds() - before) / POINTS
    before = processor_seconds()
    again = tn.sweep(study, f"{folder}/rows.csv")
    resumed = processor_seconds() - before
    assert table is not None and again is not None and table.sha256 == again.sha256
    print(f"a sweep of three taxels: {1e3 * cost:.2f} ms of processor time a point, the solving included; floor 2")
    print(f"the same again, {POINTS} points that are done: {resumed:.2f} s of processor time, table and all; floor 1")

    skin = tn.Skin(
        sensor=tn.Sensor(rows=8, columns=8, pitch=2e-3, depth=2e-3, reads=["stress_x", "shear_xy", "shear_xz"]),
        material=tn.Material(youngs_modulus=0.25e6, poisson_ratio=0.48),
        contacts=[tn.Sphere(force=0.5, radius=2.5e-3, friction=0.4)],
        noise=tn.Noise(rms=10.0),
        units={},
    )
    line = tn.Scene(
        sensor=tn.Sensor(count=41, pitch=0.5e-3, depth=1.5e-3, reads=["stress_x"]),
        material=tn.Material(youngs_modulus=0.2e6, poisson_ratio=0.45),
        contacts=[tn.Cylinder(force=50.0, half_width=2e-3)],
        noise=tn.Noise(rms=20.0),
    )
    for name, scene in (("41 taxels", line), ("a skin of 8 x 8 x 3", skin)):
        draws = tn.Study(scene, {"contact.0.force": {"from": 0.1, "to": 1.0}}, draw={"kind": "random", "count": 1000})
        begin = time.perf_counter()
        data = tn.datasets.generate(draws, f"{folder}/{name.replace(' ', '-')}.parquet", jobs=1)
        print(f"a data set of {name}: {len(data) / (time.perf_counter() - begin):.0f} points of one frame a second, one thread")
