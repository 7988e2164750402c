"""Every report, opened in a browser and measured: narrow and wide, light and dark, printed, and without scripts.

usage: pages_test.py TOOL SCENES CHROMIUM
"""

import csv
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from chromium import Chromium

TOOL, SCENES, CHROMIUM = sys.argv[1:4]
FAULTS = (pathlib.Path(__file__).parent / "faults.js").read_text()
# Window's width, whether dark is asked for, medium. Paper is A4 between its margins, and always white.
VIEWS = [(400, False, "screen"), (400, True, "screen"), (768, False, "screen"), (1400, False, "screen"), (1400, True, "screen"),
         (700, False, "print")]

# A ball that rolls over a skin, 20 frames.
ROLLS = """
[sensor]
rows = 16
columns = 16
pitch = 1.0
depth = 1.0
reads = ["stress_x", "shear_xy", "shear_xz"]
[material]
youngs_modulus = 0.25
poisson_ratio = 0.48
[time]
rate = 100.0
duration = 0.19
[[contact]]
shape = "sphere"
radius = 6.0
force = 0.4
friction = 0.4
direction = 30.0
trajectory = [{ t = 0.0, place = [-4.0, 0.0], force = 0.1 }, { t = 0.19, place = [4.0, 1.0], force = 0.4 }]
[noise]
rms = 5e-5
[reconstruct]
alpha = 1e-4
spacing = 1.0
"""

# Page, least number of its figures, command. HERE is the folder of scenes that the test writes.
COMMANDS = [
    ("run", 4, ["run", "thesis/cylinder.toml", "--compare-rules"]),
    ("run with friction", 6, ["run", "dragged-two-depths.toml"]),
    ("run over time", 7, ["run", "effects/everything.toml"]),
    ("run with a failure", 1, ["run", "thesis/example-3.2.toml", "--ngspice", "no-such-ngspice",
                               "--realization", "nic"]),
    ("identify", 2, ["identify", "thesis/cylinder.toml"]),
    ("identify two tractions", 3, ["identify", "two-strains.toml"]),
    ("certify", 4, ["certify", "circuits/least-squares.toml"]),
    ("certify converters", 4, ["certify", "circuits/nic-parasitics.toml"]),
    ("certify an unstable circuit", 3, ["certify", "ringing.toml"]),
    ("certify without time", 2, ["certify", "thesis/cylinder.toml"]),
    ("certify one frequency", 1, ["certify", "circuits/lc.toml"]),
    ("certify a skin", 5, ["certify", "skins/circuit.toml"]),
    ("tradeoff", 3, ["tradeoff", "thesis/cylinder.toml", "--digital"]),
    ("tradeoff of a skin", 4, ["tradeoff", "skins/circuit.toml", "--digital"]),
    ("grasp", 1, ["grasp", "hands/two-fingers.toml"]),
    ("grasp in space", 1, ["grasp", "hands/box.toml"]),
    ("sweep", 4, ["merge", "HERE/rows.csv"]),
    ("solve", 4, ["solve", "recorded/thin-pad.toml", "--readings", SCENES + "/recorded/thin-pad.csv"]),
    ("solve with a gap", 4, ["solve", "recorded/thin-pad.toml", "--readings", "HERE/gap.csv", "--missing", "skip"]),
    ("run a skin", 6, ["run", "skins/sphere.toml"]),
    ("solve a skin", 5, ["solve", "recorded/skin-pad.toml", "--readings", SCENES + "/recorded/skin-pad.csv"]),
    ("solve a skin of uneven taxels", 4, ["solve", "recorded/skin-pad-uneven.toml", "--readings",
                                          SCENES + "/recorded/skin-pad-uneven.csv"]),
    ("solve a curved skin", 6, ["solve", "recorded/curved-pad/cap.toml", "--readings",
                               SCENES + "/recorded/curved-pad/cap.csv"]),
    ("frames of 16 x 16 x 3", 5, ["solve", "rolls.toml", "--readings", "HERE/rolls.csv"]),
    ("identify a skin", 1, ["identify", "skins/row.toml"]),
    ("calibrate", 1, ["calibrate", "calibration/rod-layer.csv", "--scene", SCENES + "/calibration/rod-layer.toml"]),
]


def faults_of(browser, page, width, dark, medium="screen"):
    """What is wrong with a page, as sentences that begin with the kind of fault."""
    events = browser.open(page.as_uri(), width, dark, medium)
    found = browser.evaluate(FAULTS)
    faults = list(found["faults"])
    for event in events:
        what = event["params"]
        if event["method"] == "Runtime.exceptionThrown":
            faults.append("console: " + what["exceptionDetails"]["text"])
        elif event["method"] == "Runtime.consoleAPICalled" and what["type"] in ("error", "warning"):
            faults.append("console: " + str(what["args"]))
        elif event["method"] == "Log.entryAdded" and what["entry"]["level"] in ("error", "warning"):
            faults.append("console: " + what["entry"]["text"])
        elif event["method"] == "Network.requestWillBeSent" and what["request"]["url"] != page.as_uri() \
                and not what["request"]["url"].startswith("data:"):
            faults.append("not self-contained: " + what["request"]["url"])
    for link in found["links"]:
        if not (page.parent / link).is_file():
            faults.append("link: there is no " + link)
    return faults, found


class Pages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="tactile-net-pages-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.browser = cls.enterClassContext(Chromium(CHROMIUM))
        cls.pages = {}
        folder = pathlib.Path(cls.folder.name)
        # Dividers of 10 kilo-ohm ring with the capacitance at the op-amps' inputs.
        stable = pathlib.Path(SCENES, "circuits/nic-parasitics.toml").read_text().splitlines()
        (folder / "ringing.toml").write_text(
            "\n".join(line for line in stable if not line.startswith("divider")))
        (folder / "rolls.toml").write_text(ROLLS)
        subprocess.run([TOOL, "simulate", str(folder / "rolls.toml"), "-q", "-o", str(folder / "rolls.csv")], check=True)
        subprocess.run([TOOL, "sweep", SCENES + "/sweeps/depth.toml", "-q", "-o", str(folder / "rows.csv")], check=True)
        # A recording whose third frame misses.
        rows = pathlib.Path(SCENES, "recorded/thin-pad.csv").read_text().splitlines()
        time, *readings = rows[3].split(",")
        rows[3] = time + "," * len(readings)
        (folder / "gap.csv").write_text("\n".join(rows) + "\n")
        for name, _, arguments in COMMANDS:
            out = folder / name.replace(" ", "-")
            command, scene, *options = [one.replace("HERE", str(folder)) for one in arguments]
            path = next(p for p in (pathlib.Path(SCENES, scene), folder / scene) if p.exists())
            ran = subprocess.run([TOOL, command, str(path), *options, "--out", str(out)],
                                 capture_output=True, text=True, check=False)
            if ran.returncode not in (0, 1) or not (out / "report.html").exists():
                raise RuntimeError(f"{arguments}: {ran.returncode}: {ran.stderr}")
            cls.pages[name] = out / "report.html"

    def test_every_page_is_whole_at_every_width_in_both_lights(self):
        for name, figures, _ in COMMANDS:
            for view in VIEWS:
                with self.subTest(page=name, view=view):
                    faults, found = faults_of(self.browser, self.pages[name], *view)
                    self.assertEqual(faults, [])
                    self.assertGreaterEqual(found["figures"], figures)
                    self.assertGreaterEqual(found["labels"], 1)
                    self.assertGreaterEqual(len(found["links"]), figures)

    def test_every_file_beside_a_page_that_holds_a_figure_has_numbers(self):
        for name, page in self.pages.items():
            for data in page.parent.glob("*.csv"):
                with self.subTest(page=name, data=data.name):
                    self.assertGreaterEqual(len(data.read_text().splitlines()), 2)

    def test_every_file_beside_a_page_is_linked_and_the_command_is_told(self):
        commands = {name: command for name, _, (command, *_) in COMMANDS}
        for name, page in self.pages.items():
            text = page.read_text()
            self.assertIn("Made by <code>tactile-net " + commands[name], text)
            for file in page.parent.iterdir():
                with self.subTest(page=name, file=file.name):
                    if file != page:
                        self.assertIn(f'href="{file.name}"', text)

    def test_answers_and_tables_are_read_without_scripts(self):
        self.browser.call("Emulation.setScriptExecutionDisabled", value=True)
        try:
            for name, page in self.pages.items():
                with self.subTest(page=name):
                    events = self.browser.open(page.as_uri(), 768, False)
                    self.assertFalse([e for e in events if e["method"] == "Log.entryAdded"])
                    seen = self.browser.evaluate(
                        "[...document.querySelectorAll('.answers b')].filter((e) => e.checkVisibility()).length")
                    self.assertGreaterEqual(seen, 1)
                    self.assertFalse(self.browser.evaluate("!!document.querySelector('canvas')"))
            page = self.pages["solve"]
            self.browser.open(page.as_uri(), 768, False)
            rows = self.browser.evaluate("document.querySelectorAll('tbody tr').length")
            self.assertEqual(rows, len((page.parent / "shown.csv").read_text().splitlines()) - 1)
        finally:
            self.browser.call("Emulation.setScriptExecutionDisabled", value=False)

    def test_the_pointer_reads_the_values_of_the_file(self):
        page = self.pages["run a skin"]
        self.browser.open(page.as_uri(), 1400, False)
        with (page.parent / "tractions.csv").open() as file:
            cells = [{key: float(value) for key, value in row.items() if value} for row in csv.DictReader(file)]
        stress = self.data(page)["stress"]["factor"]
        largest = max(abs(cell["normal"]) for cell in cells)
        grid = self.data(page)["grid"]
        step, = self.data(page)["tractions"][0]["values"]["steps"]
        for cell in (cells[0], max(cells, key=lambda one: one["normal"]), cells[len(cells) // 3]):
            row = round((cell["y"] - grid["y"]) / grid["dy"])
            column = round((cell["z"] - grid["z"]) / grid["dz"])
            said = self.said_under("[data-view=tractions] > div:nth-child(2)", (row + 0.5) / grid["rows"],
                                   (column + 0.5) / grid["columns"])
            self.assertRegex(said, r"p .*true")
            word = re.search(r": p (\S+)", said).group(1).replace("−", "-")
            # The page has a whole number of steps, and says as many digits as the deviation has.
            last_digit = 10.0 ** -len(word.partition(".")[2])
            self.assertAlmostEqual(float(word), cell["normal"] * stress, delta=0.51 * (step * stress + last_digit))
            self.assertLess(step * stress + last_digit, 0.05 * largest * stress)

    def said_under(self, place, across, down, picture=".map-box"):
        """What a picture says of the place under the pointer, as shares of its width and height."""
        return self.browser.evaluate(f"""(() => {{
          const place = document.querySelector('{place}'), picture = place.querySelector('{picture}');
          const box = picture.getBoundingClientRect();
          picture.dispatchEvent(new PointerEvent('pointermove', {{bubbles: true,
            clientX: box.left + {across} * box.width, clientY: box.top + {down} * box.height}}));
          return place.querySelector('.readout').textContent;
        }})()""").replace("−", "-")

    def test_the_pointer_reads_of_a_skin_what_the_sentence_says(self):
        units = {"mm": 1e-3, "µm": 1e-6, "kPa": 1e3, "Pa": 1.0, "MPa": 1e6}
        number = r"(\S+) (\S+)"
        for name in ("certify a skin", "tradeoff of a skin"):
            page = self.pages[name]
            text = page.read_text()
            said = re.search(rf"hardest at y = {number}, z = {number}: {number}\.<", text).groups()
            y, z, p = (float(value) * units[unit] for value, unit in zip(said[::2], said[1::2]))
            self.browser.open(page.as_uri(), 1400, False)
            grid = self.browser.evaluate("JSON.parse(document.querySelector('.frames script').textContent).grid")
            row, column = round((y - grid["y"]) / grid["dy"]), round((z - grid["z"]) / grid["dz"])
            read = self.said_under("[data-view=tractions] > div", (row + 0.5) / grid["rows"],
                                   (column + 0.5) / grid["columns"])
            value, unit = re.search(rf": p {number}, q_y", read).groups()
            # A page has a 300th of the largest value, and says four digits.
            self.assertAlmostEqual(float(value) * units[unit], p, delta=0.005 * p)

    def test_the_pointer_reads_the_waves_of_a_survey(self):
        page = self.pages["identify a skin"]
        self.browser.open(page.as_uri(), 1400, False)
        data = self.data(page)
        with (page.parent / "waves.csv").open() as file:
            waves = list(csv.DictReader(file))
        along, across = (sorted({abs(float(wave[key])) for wave in waves}) for key in ("wavenumber_y", "wavenumber_z"))
        amplitudes = []
        for wave in waves:
            if not wave["pressure"]:
                continue
            row, column = along.index(abs(float(wave["wavenumber_y"]))), across.index(abs(float(wave["wavenumber_z"])))
            said = self.said_under(".waves > div", (row + 0.5) / len(data["y"]), (column + 0.5) / len(data["z"]))
            amplitudes.append(float(re.search(r": (\S+) times the noise", said).group(1)) * float(wave["pressure"]))
        self.assertGreater(len(amplitudes), 3)
        for amplitude in amplitudes:  # of one ripple, in deviations of its own
            self.assertAlmostEqual(amplitude / amplitudes[0], 1.0, delta=0.02)

    def test_the_pointer_reads_the_load_and_the_stress_of_a_pad(self):
        page = self.pages["run"]
        self.browser.open(page.as_uri(), 1400, False)
        data = self.data(page)
        with (page.parent / "truth.csv").open() as file:
            row = next(csv.DictReader(file))
        truth = [float(value) * data["stress"]["factor"] for name, value in row.items() if name.startswith("normal")]
        count, most = len(truth), max(truth)
        self.assertEqual(count, data["grid"]["rows"])
        for i in (0, truth.index(most), count // 3):
            said = self.said_under("[data-view=pad]", (i + 0.5) / count, -0.05, ".pad")
            self.assertAlmostEqual(float(re.search(r": p (\S+)", said).group(1)), truth[i], delta=0.005 * most)
        below = self.said_under("[data-view=pad]", (truth.index(most) + 0.5) / count, 0.02, ".pad")
        self.assertRegex(below, r"^y \S+, depth \S+.*: stress \S+")

    def test_the_pointer_reads_truth_and_band_of_a_plot(self):
        page = self.pages["run"]
        self.browser.open(page.as_uri(), 1400, False)
        said = self.browser.evaluate("""(() => {
          const figure = document.getElementById('normal'), over = figure.querySelector('.u-over');
          const box = over.getBoundingClientRect();
          over.dispatchEvent(new MouseEvent('mousemove', {clientX: box.left + 0.5 * box.width,
                                                          clientY: box.top + 0.5 * box.height}));
          return figure.querySelector('.readout').textContent;
        })()""").replace("−", "-")
        place, truth = (float(re.search(what + r" ([-\d.e]+)", said).group(1)) for what in (r"^y \[.*?\]", "truth"))
        with (page.parent / "normal.csv").open() as file:
            head, *rows = csv.reader(file)
        nearest = min(rows, key=lambda row: abs(float(row[0]) - place))
        self.assertAlmostEqual(float(nearest[head.index("truth")]), truth, delta=1e-3 * abs(truth))
        self.assertRegex(said, r"\[.*\].*: \S.*( ± | \(\S+ to ).*truth")

    def test_the_contacts_of_a_frame_are_rows_that_agree_with_its_sentence(self):
        page = self.pages["frames of 16 x 16 x 3"]
        self.browser.open(page.as_uri(), 1400, False)
        seen = 0
        for k, rows in enumerate(self.data(page)["contacts"]["rows"]):
            said, force, shown = self.browser.evaluate(f"""(() => {{
              const slider = document.querySelector('[data-view=slider]');
              slider.value = {k};
              slider.dispatchEvent(new Event('input'));
              const cells = [...document.querySelectorAll('[data-view=contacts] td:nth-child(2)')];
              return [document.querySelector('[data-view=answer]').textContent, cells[0].textContent,
                      cells.filter((cell) => cell.textContent !== '–').length];
            }})()""")
            self.assertEqual(shown, len(rows))
            if len(rows) == 1:  # the sum is that of the one contact
                self.assertTrue(said.startswith(f"force {force}, "), (said, force))
                seen += 1
        self.assertGreater(seen, 3)

    def test_a_curved_skin_is_drawn_from_three_sides_frame_by_frame(self):
        page = self.pages["solve a curved skin"]
        self.browser.open(page.as_uri(), 1400, False)
        data = self.data(page)
        surface, grid = data["surface"], data["grid"]
        count = grid["rows"] * grid["columns"]
        views = self.browser.evaluate("""[...document.querySelectorAll('[data-view=sides] > div')].map((view) => ({
          title: view.querySelector('.map-title').textContent,
          ends: [...view.querySelectorAll('.ends span')].map((end) => end.textContent),
          cells: [...view.querySelectorAll('path')].filter((path) => path.cell !== undefined).length,
          faint: [...view.querySelectorAll('path')].filter((path) => path.cell !== undefined &&
                                                            path.getAttribute('opacity') < 1).length}))""")
        self.assertEqual([one["title"] for one in views], ["Seen from +x", "Seen from −y", "Seen from +z"])
        self.assertEqual([one["cells"] for one in views], [count] * 3)
        # The cap looks along z: all of it is seen from there, half of it from each side.
        self.assertEqual(views[2]["faint"], 0)
        for side in views[:2]:
            self.assertAlmostEqual(side["faint"], count / 2, delta=grid["rows"])
        # The drawings reach over the surface, in the scene's unit.
        for view, axis in zip(views, (1, 0, 0)):
            low, word, high = (end.replace("−", "-") for end in view["ends"])
            self.assertEqual(word, "xyz"[axis] + " →")
            self.assertTrue(high.endswith(" mm"))
            along = [1e3 * surface["step"] * one for one in surface["corners"][axis]]
            self.assertLess(float(low), min(along))
            self.assertGreater(float(high.removesuffix(" mm")), max(along))
        seen = set()
        for k in range(len(surface["forces"])):
            answer, said, labels, arrows, outlines, fills, hover = self.browser.evaluate(f"""(() => {{
              const slider = document.querySelector('[data-view=slider]');
              slider.value = {k};
              slider.dispatchEvent(new Event('input'));
              const figure = document.querySelector('[data-view=sides]').parentElement;
              const all = [...figure.querySelectorAll('svg')];
              const cells = [...all[2].querySelectorAll('path')].filter((path) => path.cell !== undefined);
              const last = all.map((svg) => [...svg.querySelectorAll('path')].slice(-3).map((path) => path.getAttribute('d') ?? ''));
              const values = cells.map((path) => [path.cell, path.getAttribute('fill')]);
              const under = cells[Math.floor(cells.length / 2)];
              under.dispatchEvent(new PointerEvent('pointermove', {{bubbles: true}}));
              const map = document.querySelector('[data-view=tractions]');
              return [document.querySelector('[data-view=answer]').textContent, figure.querySelector('p.quiet').textContent,
                      all.map((svg) => svg.getAttribute('aria-label')), last.map((one) => one[2]), last.map((one) => one[0]),
                      values, [figure.querySelector('.readout').textContent, map.querySelector('.readout').textContent]];
            }})()""")
            force = surface["forces"][k]
            self.assertEqual(said, force["words"] if force else "nothing presses")
            if force:
                self.assertTrue(answer.startswith(said + "; "), (answer, said))
            for label, view in zip(labels, views):
                self.assertTrue(label.endswith(view["title"][1:] + ": " + said), label)
            self.assertEqual([bool(one) for one in arrows], [bool(force)] * 3)
            # From a side contacts on the far half are out of sight.
            self.assertEqual(bool(outlines[2]), bool(data["touching"][k]))
            seen.add(tuple(arrows))
            # The cell under the pointer is told as on the map.
            self.assertIn(hover[1].partition(": ")[2], hover[0])
            self.assertRegex(hover[0], r": p \S+")
            if k == len(surface["forces"]) - 1 or not force:
                continue
            # What presses hardest is bluest: the least red of all.
            red = {cell: int(fill.removeprefix("rgb(").partition(",")[0]) for cell, fill in fills}
            touching = {first + i for first, length in data["touching"][k] for i in range(length)}
            if touching and abs(force["force"][2]) > 0.3 * surface["largest"]:
                self.assertIn(min(red, key=red.get), touching)
        self.assertGreater(len(seen), 4)

    def test_an_arrow_of_a_hand_tells_its_row_of_the_table(self):
        for name in ("grasp", "grasp in space"):
            self.browser.open(self.pages[name].as_uri(), 1400, False)
            rows, titles = self.browser.evaluate("""[
              [...document.querySelectorAll('.cards tbody tr')].map((row) => [...row.cells].map((cell) =>
                [cell.dataset.label, cell.textContent.replace(/^\\W /, '')])),
              [...document.querySelectorAll('.hand title')].map((title) => title.textContent)]""")
            self.assertGreater(len(rows), 1)
            for row in rows:
                told = [title for title in titles if title.startswith(row[0][1] + ": ")]
                self.assertTrue(any(all(f"{label} {text}" in title for label, text in row[1:]) for title in told),
                                (row, told))

    def test_pictures_over_time_are_empty_where_a_frame_is_missing(self):
        page = self.pages["solve with a gap"]
        frames = self.data(page)["frames"]
        self.assertEqual(frames["number"], [0, 1, 3, 4, 5, 6])
        self.assertEqual(frames["gaps"], [2])
        self.browser.open(page.as_uri(), 1400, False)
        # Coloured pixels of every chart's column at a time; the axes are grey.
        ink = self.browser.evaluate("""(() => {
          const charts = [...document.querySelectorAll('[data-view=time] .plot-box')].map((box) => {
            const canvas = box.querySelector('canvas'), over = box.querySelector('.u-over');
            const left = over.getBoundingClientRect().left - canvas.getBoundingClientRect().left;
            return (time) => {
              const x = Math.round(left + over.clientWidth * time / 0.06);
              const pixels = canvas.getContext('2d').getImageData(x, 0, 1, canvas.height).data;
              let count = 0;
              for (let i = 0; i < pixels.length; i += 4)
                if (Math.max(...pixels.slice(i, i + 3)) > Math.min(...pixels.slice(i, i + 3)) + 20) ++count;
              return count;
            };
          });
          return charts.map((at) => [0.0075, 0.018, 0.022, 0.0425].map(at));
        })()""")
        self.assertGreaterEqual(len(ink), 5)
        for before, first, last, after in ink:
            self.assertEqual((first, last), (0, 0))
        self.assertGreaterEqual(sum(after > 0 for *_, after in ink), 5, ink)

    def test_a_thousand_frames_of_a_skin_are_quick(self):
        # More than a page has (lab::Recording::most_skin_values); how large it is, C++ tests.
        page = self.pages["frames of 16 x 16 x 3"]
        data = self.data(page)
        once = len(data["frames"]["number"])
        times = 1000 // once
        self.assertEqual(data["tractions"][2]["values"]["size"], data["grid"]["rows"] * data["grid"]["columns"])
        self.assertEqual([one["values"]["size"] for one in data["readings"]], [256] * 3)

        def repeat(packed):
            if packed and len(packed["steps"]) == once:
                packed["steps"] *= times
                packed["text"] *= times

        for one in data["tractions"]:
            if one is not data["tractions"][0]:
                one["deviations"] = None  # as of every page with so many values
            for which in ("values", "deviations", "truth"):
                repeat(one[which])
        for one in data["readings"]:
            repeat(one["values"])
        for course in data["courses"]:
            for line in course["lines"]:
                for which in ("y", "low", "high"):
                    if which in line:
                        line[which] *= times
        data["touching"] = data["touching"] and data["touching"] * times
        data["contacts"]["rows"] *= times
        frames = data["frames"]
        for which in ("distrusted", "place", "answer", "trust"):
            frames[which] *= times
        frames["number"] = list(range(once * times))
        frames["time"] = [0.01 * k for k in frames["number"]]
        text = page.read_text()
        begin, end = self.place_of_data(text)
        folder = pathlib.Path(self.folder.name) / "long"
        folder.mkdir()
        long = folder / "report.html"
        long.write_text(re.sub(r' max="\d+" aria-label="frame"', f' max="{once * times - 1}" aria-label="frame"', text[:begin]) +
                        json.dumps(data, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c") + text[end:])
        self.browser.open(long.as_uri(), 1400, False)
        painted = self.browser.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
        self.assertLess(painted, 1000)
        step = self.browser.call("Runtime.evaluate", awaitPromise=True, returnByValue=True, expression="""(async () => {
          const slider = document.querySelector('[data-view=slider]'), steps = [];
          for (let i = 0; i < 50; ++i) {
            slider.value = 20 * i;
            const begin = performance.now();
            slider.dispatchEvent(new Event('input'));
            await null;
            document.body.offsetHeight;
            steps.push(performance.now() - begin);
            await new Promise(requestAnimationFrame);
          }
          return steps.sort((a, b) => a - b)[25];
        })()""")["result"]["value"]
        self.assertLess(step, 30)

    def place_of_data(self, text):
        mark = '<script type="application/json">'
        begin = text.index(mark) + len(mark)
        return begin, text.index("</script>", begin)

    def data(self, page):
        text = page.read_text()
        begin, end = self.place_of_data(text)
        return json.loads(text[begin:end])

    def test_a_page_that_is_broken_is_found_out(self):
        page = self.pages["run"]
        whole = page.read_text()
        label = '<text x="90" y="90"><tspan>label</tspan></text>'
        breaks = [
            ("console", "</body>", "<script>throw Error('no')</script></body>"),
            ("overflow", "</body>", "<div style='width: 99rem'>wide</div></body>"),
            ("overlap: <text>", "</svg>", label + label + "</svg>"),
            ("overlap: <h2>", "h2 {", "h2 { margin-bottom: -2rem !important;"),
            ("cut off: <text>", "</svg>", label.replace('x="90"', 'x="9999"') + "</svg>"),
            ("small", "</svg>", label.replace("<text", "<text style='font-size: 3px'") + "</svg>"),
            ("contrast", "</body>", "<p style='color: #888; background: #777'>grey</p></body>"),
            ("colours", "prefers-color-scheme: dark", "prefers-color-scheme: light"),
            ("link", 'href="normal.csv"', 'href="absent.csv"'),
            ("figure", "<figcaption>", "<figcaption hidden></figcaption><figcaption>"),
            ("name", 'aria-label="Section', 'data-label="Section'),
            ("answer: there", 'class="answers"', 'class="replies"'),
            ("answer: it", 'class="answers"', 'style="margin-top: 60rem" class="answers"', 1400),
            ("verdict", '<td data-label="verdict">', '<td data-label="verdict" style="display: none">'),
            ("verdict", '<td data-label="verdict">', '<td data-label="verdict" style="position: relative; left: 30rem">'),
            ("not self-contained", "</body>", "<img src='network.cir' alt=''></body>"),
        ]
        broken = page.parent / "broken.html"  # its links lead to the files beside it
        self.addCleanup(broken.unlink, missing_ok=True)
        for fault, good, bad, *width in breaks:
            with self.subTest(fault=fault):
                self.assertIn(good, whole)
                broken.write_text(whole.replace(good, bad, 1))
                found, _ = faults_of(self.browser, broken, *(width or [400]), True)
                self.assertTrue(any(one.startswith(fault) for one in found), found)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
