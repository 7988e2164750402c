"""What a notebook shows: tables, and curves over y as an SVG of our own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from ._arrays import Floats

_ESCAPES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})
_COLOURS = ("#888888", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")
_WIDTH, _HEIGHT, _MARGIN = 640, 200, 12


def escape(text: str) -> str:
    return text.translate(_ESCAPES)


def paragraphs(sentences: Iterable[str]) -> str:
    return "".join(f"<p>{escape(sentence)}</p>" for sentence in sentences if sentence)


def preformatted(text: str) -> str:
    return f"<pre>{escape(text)}</pre>"


def table(rows: Sequence[Sequence[str]]) -> str:
    """The first row is the header."""
    head, *body = rows
    cells = "".join(f"<th>{escape(cell)}</th>" for cell in head)
    lines = ("".join(f"<td>{escape(cell)}</td>" for cell in row) for row in body)
    return f"<table><tr>{cells}</tr>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def page(html: str) -> str:
    """A whole page, in a frame of its own so that its style stays its own."""
    return f'<iframe srcdoc="{escape(html)}" style="width:100%;height:720px;border:0"></iframe>'


def curves(y: Floats, named: Sequence[tuple[str, Floats]]) -> str:
    """Curves over y, each with its name in its colour; values that are not finite leave a gap."""
    finite = [values[np.isfinite(values)] for _, values in named]
    heights = np.concatenate([*finite, np.zeros(1)])
    low, high = float(heights.min()), float(heights.max())
    inner = _HEIGHT - 3 * _MARGIN

    def across(at: Floats) -> Floats:
        return np.asarray(_MARGIN + (at - y[0]) / ((y[-1] - y[0]) or 1.0) * (_WIDTH - 2 * _MARGIN))

    def down(values: Floats) -> Floats:
        return 2 * _MARGIN + (high - values) / ((high - low) or 1.0) * inner

    drawn = [f'<path d="M{_MARGIN} {down(np.zeros(1))[0]:.1f}H{_WIDTH - _MARGIN}" stroke="currentColor" opacity=".3"/>']
    for i, (name, values) in enumerate(named):
        colour = _COLOURS[i % len(_COLOURS)]
        seen = np.isfinite(values)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(across(y[seen]), down(values[seen])))
        drawn.append(f'<polyline points="{points}" fill="none" stroke="{colour}" stroke-width="1.5"/>')
        drawn.append(
            f'<text x="{_MARGIN + 120 * i}" y="{_MARGIN}" font-size="12" fill="{colour}">{escape(name)}</text>'
        )
    return (
        f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" width="{_WIDTH}" role="img" '
        f'aria-label="{escape(", ".join(name for name, _ in named))}">' + "".join(drawn) + "</svg>"
    )
