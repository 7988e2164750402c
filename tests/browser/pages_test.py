"""Every report, opened in a browser and measured: narrow and wide, light and dark, and printed.

usage: pages_test.py TOOL SCENES CHROMIUM
"""

import pathlib
import subprocess
import sys
import tempfile
import unittest

from chromium import Chromium

TOOL, SCENES, CHROMIUM = sys.argv[1:4]
FAULTS = (pathlib.Path(__file__).parent / "faults.js").read_text()
# Window's width, whether dark is asked for, medium. Paper is A4 between its margins, and always white.
VIEWS = [(400, False, "screen"), (400, True, "screen"), (800, False, "screen"), (1400, False, "screen"), (1400, True, "screen"),
         (700, False, "print")]

# Page, least number of its figures, command.
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
    ("tradeoff", 3, ["tradeoff", "thesis/cylinder.toml", "--digital"]),
    ("grasp", 1, ["grasp", "hands/two-fingers.toml"]),
    ("grasp in space", 1, ["grasp", "hands/box.toml"]),
    ("sweep", 4, ["sweep", "sweeps/depth.toml"]),
    ("solve", 3, ["solve", "recorded/thin-pad.toml", "--readings", SCENES + "/recorded/thin-pad.csv"]),
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
        for name, _, arguments in COMMANDS:
            out = folder / name.replace(" ", "-")
            command, scene, *options = arguments
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
                    self.assertGreaterEqual(found["labels"], 2)
                    self.assertGreaterEqual(len(found["links"]), figures)

    def test_every_file_beside_a_page_that_holds_a_figure_has_numbers(self):
        for name, page in self.pages.items():
            for data in page.parent.glob("*.csv"):
                with self.subTest(page=name, data=data.name):
                    self.assertGreaterEqual(len(data.read_text().splitlines()), 2)

    def test_every_file_beside_a_page_is_linked_and_the_command_is_told(self):
        for name, page in self.pages.items():
            text = page.read_text()
            self.assertIn("Made by <code>tactile-net " + name.split()[0], text)
            for file in page.parent.iterdir():
                with self.subTest(page=name, file=file.name):
                    if file != page and file.is_file():  # the journals of a sweep are in folders
                        self.assertIn(f'href="{file.name}"', text)

    def test_a_page_that_is_broken_is_found_out(self):
        page = self.pages["run"]
        whole = page.read_text()
        label = '<text x="90" y="90"><tspan>label</tspan></text>'
        breaks = [
            ("console", "</body>", "<script>throw Error('no')</script></body>"),
            ("overflow", "</body>", "<div style='width: 99rem'>wide</div></body>"),
            ("overlap: <text>", "</svg>", label + label + "</svg>"),
            ("overlap: <h2>", "h2 {", "h2 { margin-bottom: -2rem !important;"),
            ("cut off", "</svg>", label.replace('x="90"', 'x="9999"') + "</svg>"),
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
        broken = page.parent / "broken.html"
        for fault, good, bad, *width in breaks:
            with self.subTest(fault=fault):
                self.assertIn(good, whole)
                broken.write_text(whole.replace(good, bad, 1))
                found, _ = faults_of(self.browser, broken, *(width or [400]), True)
                self.assertTrue(any(one.startswith(fault) for one in found), found)
        broken.unlink()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
