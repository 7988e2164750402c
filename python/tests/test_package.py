"""What is in the wheel, and what it asks for."""

from __future__ import annotations

import doctest
import importlib.metadata
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PROJECT

import tactile_net as tn
from tactile_net import _core

PACKAGE = Path(tn.__file__).parent


def test_the_version_stands_once() -> None:
    written = re.search(r"project\(tactile_net VERSION ([\d.]+)", (PROJECT / "CMakeLists.txt").read_text())
    assert written is not None
    assert tn.__version__ == importlib.metadata.version("tactile-net") == written[1]


def test_numpy_and_a_writer_of_toml_are_all_that_is_needed() -> None:
    asked = importlib.metadata.requires("tactile-net") or []
    assert [one for one in asked if "extra ==" not in one] == ["numpy>=1.26", "tomli-w>=1.0"]
    script = "import sys, tactile_net; print(*sorted({m.partition('.')[0] for m in sys.modules} & set(sys.argv[1:])))"
    others = ["matplotlib", "mujoco", "pandas", "xarray", "tqdm", "h5netcdf", "zarr", "pyarrow", "mcap", "rosbags"]
    done = subprocess.run([sys.executable, "-c", script, *others], capture_output=True, text=True, check=True)
    assert done.stdout.split() == []


def test_the_module_needs_no_library_of_its_own() -> None:
    listed = subprocess.run(["ldd", str(_core.__file__)], capture_output=True, text=True, check=True).stdout
    names = {line.split()[0].partition(".so")[0] for line in listed.splitlines()}
    assert names <= {"linux-vdso", "libstdc++", "libm", "libgcc_s", "libc", "libpthread", "/lib64/ld-linux-x86-64"}, (
        names
    )


def test_licences_travel_with_it() -> None:
    files = importlib.metadata.files("tactile-net") or []
    texts = {file.name: file.read_text() for file in files if "licenses" in file.parts}
    assert set(texts) == {"LICENSE", "NOTICES.txt", "MPL-2.0.txt"}
    for name in ("Eigen", "Boost", "toml++", "nlohmann", "nanobind", "robin-map", "uPlot"):
        assert name in texts["NOTICES.txt"]


def test_every_name_is_exported_typed_and_explained() -> None:
    assert (PACKAGE / "py.typed").exists()
    assert [name for name in tn.__all__ if not hasattr(tn, name)] == []
    assert tn.__all__ == sorted(tn.__all__)
    unexplained = [name for name in tn.__all__ if isinstance(getattr(tn, name), type) and not getattr(tn, name).__doc__]
    assert unexplained == []
    stub = (PACKAGE / "_core.pyi").read_text()
    assert "std::" not in stub and "tactile_net::" not in stub


@pytest.mark.parametrize("module", sorted(PACKAGE.rglob("*.py")), ids=lambda path: str(path.relative_to(PACKAGE)))
def test_examples_in_docstrings(module: Path) -> None:
    name = ".".join(["tactile_net", *module.relative_to(PACKAGE).with_suffix("").parts]).removesuffix(".__init__")
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_a_wheel_without_its_parts(tmp_path: Path) -> None:
    """All else works, and where a part is asked for it is told that it was left out."""
    without = shutil.copytree(PACKAGE, tmp_path / "tactile_net", ignore=shutil.ignore_patterns("logs", "mujoco"))
    script = """
import sys, tactile_net as tn
from tactile_net import *
assert tn.__file__.startswith(sys.argv[1]) and not {"logs", "mujoco"} & set(tn.__all__)
scene = tn.Scene.load(sys.argv[2])
for ask in (lambda: tn.logs, lambda: tn.mujoco.Pad, lambda: scene.simulate().save("x.mcap")):
    try:
        ask()
    except (AttributeError, ImportError) as error:
        print(error)
"""
    scene = PROJECT / "scenes/fingertip.toml"
    done = subprocess.run(
        [sys.executable, "-c", script, without, scene], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    said = [f"this tactile-net was built without tactile_net.{name}: build" for name in ("logs", "mujoco", "logs")]
    assert all(line.startswith(start) for line, start in zip(done.stdout.splitlines(), said, strict=True))


def test_extras_say_how_to_come_by_them(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    scene = tn.Scene.load(PROJECT / "scenes/fingertip.toml")
    with pytest.raises(ImportError, match=r"pip install pandas, or tactile-net\[tables\]"):
        scene.simulate().to_dataframe()
    monkeypatch.setitem(sys.modules, "tqdm", None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert len(scene.simulate(progress=True)) >= 1, "a bar is a nicety"
