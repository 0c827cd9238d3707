"""Forms of files that figures are written in, and their media types."""

from typing import Final, Literal, get_args

Form = Literal["png", "svg", "pdf", "eps"]
FORMS: Final[tuple[Form, ...]] = get_args(Form)
MEDIA_TYPES: Final[dict[Form, str]] = {
    "png": "image/png",
    "svg": "image/svg+xml",
    "pdf": "application/pdf",
    "eps": "application/postscript",
}
IN_WORDS: Final = f"{', '.join(FORMS[:-1])} or {FORMS[-1]}"
