"""Tables and pictures as HTML."""

import base64
from collections.abc import Iterable, Sequence
from html import escape
from itertools import groupby

from jointplay.paper.comparison import Cell, Row


def image(png: bytes, alternative: str, caption: str) -> str:
    """Return a figure with its picture inside."""
    data = base64.b64encode(png).decode("ascii")
    return (
        f'<figure><img src="data:image/png;base64,{data}" alt="{escape(alternative)}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
    )


def table(caption: str, first: Sequence[str], columns: Sequence[str], rows: Iterable[Row]) -> str:
    """Return a table of comparisons.

    Parameters
    ----------
    first
        Titles of the columns for case, quantity and printed numbers.
    columns
        Titles of the columns for ours.
    """
    titles = [*first, *columns, "why"]
    head = "".join(f'<th scope="col">{escape(title)}</th>' for title in titles)
    body = []
    for case, group in groupby(rows, lambda row: row.case):
        members = list(group)
        for index, row in enumerate(members):
            begin = (
                f'<th scope="rowgroup" rowspan="{len(members)}">{escape(case)}</th>'
                if index == 0
                else ""
            )
            body.append(_row(row, begin))
        body.append("</tbody><tbody>")
    return (
        f"<table><caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead>"
        f"<tbody>{''.join(body[:-1])}</tbody></table>"
    )


def listing(caption: str, titles: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a plain table of texts."""
    head = "".join(f'<th scope="col">{escape(title)}</th>' for title in titles)
    body = "".join(
        "<tr>" + "".join(f"<td>{escape(text)}</td>" for text in row) + "</tr>" for row in rows
    )
    return (
        f"<table><caption>{escape(caption)}</caption><thead><tr>{head}</tr></thead>"
        f"<tbody>{body}</tbody></table>"
    )


def bullets(lines: Iterable[str]) -> str:
    """Return sentences as a list."""
    return "<ul>" + "".join(f"<li>{escape(line)}</li>" for line in lines) + "</ul>"


def _row(row: Row, begin: str) -> str:
    places = escape(" ".join(row.pointers))
    marked = f' data-reported="{places}"' if places else ""
    why = " ".join(f'<a href="#cause-{cause}">{cause}</a>' for cause in row.causes)
    return (
        f'<tr{marked}>{begin}<th scope="row">{escape(row.quantity)}</th>'
        f'<td class="printed">{escape(row.printed)}</td>'
        + "".join(_cell(cell) for cell in row.cells)
        + f'<td class="why">{why}</td></tr>'
    )


def _cell(cell: Cell) -> str:
    details = "".join(f"<small>{escape(line)}</small>" for line in cell.details)
    ratio = "" if cell.ratio is None else f' <b title="ours over printed">×{cell.ratio:.2f}</b>'
    return f'<td class="{cell.grade}">{escape(cell.main)}{ratio}{details}</td>'
