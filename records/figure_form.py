"""Forms of files that figures and films are written in, and media types of figures."""

from typing import Final, Literal, get_args

Form = Literal["png", "svg", "pdf", "eps"]
FilmForm = Literal["gif", "mp4", "webm"]
FILM_FORMS: Final[tuple[FilmForm, ...]] = get_args(FilmForm)
FORMS: Final[tuple[Form, ...]] = get_args(Form)
MEDIA_TYPES: Final[dict[Form, str]] = {
    "png": "image/png",
    "svg": "image/svg+xml",
    "pdf": "application/pdf",
    "eps": "application/postscript",
}
IN_WORDS: Final = f"{', '.join(FORMS[:-1])} or {FORMS[-1]}"
