"""Addresses at which one object of a known size may be put, signed as AWS Signature Version 4 says.

Written here because the client of buckets signs no header but the host, so that an object of any
size could be put at its addresses.
"""

import hmac
import os
from datetime import UTC, datetime
from hashlib import sha256
from math import ceil
from typing import Final
from urllib.parse import quote, urlencode

_ALGORITHM: Final = "AWS4-HMAC-SHA256"
_SIGNED: Final = "content-length;host"
"""Headers that a request must have as they were signed, by name."""
_UNSIGNED: Final = "UNSIGNED-PAYLOAD"


def address_to_put(
    endpoint: str,
    path: str,
    region: str,
    seconds: float,
    size: int,
    *,
    moment: datetime | None = None,
) -> str | None:
    """Sign an address for one PUT of an object.

    Parameters
    ----------
    endpoint
        Address of the store, without a path.
    path
        Bucket and key, with slashes between.
    region
        Of the store.
    seconds
        For which the address is good.
    size
        Bytes that the object must have.
    moment
        From which on it is; by default now.

    Returns
    -------
    str or None
        None without credentials in the environment.
    """
    from httpx import URL

    key, secret = os.environ.get("AWS_ACCESS_KEY_ID"), os.environ.get("AWS_SECRET_ACCESS_KEY")
    if not (key and secret):
        return None
    now = f"{moment or datetime.now(UTC):%Y%m%dT%H%M%SZ}"
    scope = f"{now[:8]}/{region}/s3/aws4_request"
    given = {
        "X-Amz-Algorithm": _ALGORITHM,
        "X-Amz-Credential": f"{key}/{scope}",
        "X-Amz-Date": now,
        "X-Amz-Expires": str(ceil(seconds)),
        "X-Amz-SignedHeaders": _SIGNED,
    }
    if token := os.environ.get("AWS_SESSION_TOKEN"):
        given["X-Amz-Security-Token"] = token
    query = urlencode(sorted(given.items()), quote_via=quote, safe="~")
    there = f"/{quote(path, safe='/~')}"
    host = URL(endpoint).netloc.decode()  # as clients send it: small, without the usual port
    headers = f"content-length:{size}\nhost:{host}\n"
    request = "\n".join(("PUT", there, query, headers, _SIGNED, _UNSIGNED))
    digest = sha256(request.encode()).hexdigest()
    signed = "\n".join((_ALGORITHM, now, scope, digest))
    signature = hmac.new(_signing_key(secret, scope), signed.encode(), sha256).hexdigest()
    return f"{endpoint}{there}?{query}&X-Amz-Signature={signature}"


def _signing_key(secret: str, scope: str) -> bytes:
    found = f"AWS4{secret}".encode()
    for part in scope.split("/"):
        found = hmac.digest(found, part.encode(), "sha256")
    return found
