"""Whether a service may listen where it is told to: beyond this machine, only with a key."""

import os
from contextlib import closing

from jointplay.service.loopback import is_loopback
from jointplay.storage.catalogue.catalogue import Catalogue
from jointplay.storage.settings import Settings


def require_key_beyond_this_machine(host: str, *, again: bool) -> None:
    """Decide whether keys are asked for, for all of this process; end it if there is none then.

    `JOINTPLAY_KEYS` decides if it is set. A host that names no address of this machine alone may be
    reached by anybody. With `again` nobody's key is looked for: there was one before.
    """
    settings = Settings()
    if settings.keys == "none" or (is_loopback(host) and not settings.keys):
        return
    os.environ["JOINTPLAY_KEYS"] = "required"
    if again:
        return
    with closing(Catalogue(settings.catalogue_url)) as catalogue:
        catalogue.migrate()
        now = catalogue.clock()
        if not any(key.lives(now) for key in catalogue.all_keys()):
            of_data = (
                f" --data {settings.data}" if settings.catalogue_url.startswith("sqlite") else ""
            )
            why = f"others can reach {host}"
            if settings.keys == "required":
                why = "keys are required"
            raise SystemExit(
                f"nobody has a key, and {why}: make one with `jointplay key new"
                f" --owner NAME{of_data}`, or set JOINTPLAY_KEYS=none to let everybody do"
                " everything"
            )
