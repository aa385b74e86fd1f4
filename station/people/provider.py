"""Requests to an OpenID Connect provider, and the validation of its answers.

Authorization code with PKCE (OpenID Connect Core 1.0, section 3.1; RFC 7636).  Requests and answers are
Authlib's, the signature and the claims of the ID token joserfc's.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from pydantic import BaseModel, ValidationError

from station.errors import InputRefused
from station.settings import OpenIdSettings

log = logging.getLogger(__name__)

TIMEOUT_S = 10.0
ALGORITHMS = ["RS256", "RS384", "RS512", "PS256", "PS384", "PS512", "ES256", "ES384", "ES512", "Ed25519"]
"""Only the provider can sign with these; `none`, and the client's secret, are not accepted."""
_LEEWAY_S = 60

Why = Literal["unreachable", "cancelled", "expired", "not_valid", "no_role", "name_taken", "disabled"]


class SignInRefused(Exception):
    """Why nobody was signed in, for which the page has a sentence; the text is for the log."""

    def __init__(self, why: Why, text: str) -> None:
        super().__init__(text)
        self.why = why


@dataclass(frozen=True, slots=True)
class Attempt:
    """A sign-in in progress, with its own secrets."""

    verifier: str
    nonce: str
    redirect_uri: str
    """Address that the provider redirects the browser back to."""


class _Metadata(BaseModel):
    """The required part of the metadata (OpenID Connect Discovery 1.0, section 3)."""

    issuer: str
    authorization_endpoint: str
    token_endpoint: str
    jwks_uri: str
    userinfo_endpoint: str | None = None
    end_session_endpoint: str | None = None


class Provider:
    """Every method waits for the provider, `TIMEOUT_S` for each answer, and raises `SignInRefused`."""

    def __init__(self, settings: OpenIdSettings) -> None:
        """:raises InputRefused: the client's secret cannot be read."""
        self._settings, self._secret = settings, _secret(settings)

    def address(self, attempt: Attempt, state: str) -> str:
        """The sign-in address for the browser."""
        with self._client(attempt.redirect_uri) as client:
            url, _ = client.create_authorization_url(
                self._metadata(client).authorization_endpoint,
                state=state,
                code_verifier=attempt.verifier,
                nonce=attempt.nonce,
            )
        return str(url)

    def claims(self, attempt: Attempt, code: str, wanted: tuple[str, ...]) -> Mapping[str, Any]:
        """Validated claims about the user of the returned code.

        :param wanted: names of claims; if the ID token lacks one, the user info is requested as well
        """
        with self._client(attempt.redirect_uri) as client:
            metadata = self._metadata(client)
            token = _answered(
                lambda: client.fetch_token(
                    metadata.token_endpoint,
                    grant_type="authorization_code",
                    code=code,
                    code_verifier=attempt.verifier,
                )
            )
            keys = _answered(lambda: _got(client, metadata.jwks_uri).json())
            claims = self._checked(token, keys, attempt.nonce)
            if metadata.userinfo_endpoint and any(claim(claims, name) is None for name in wanted):
                more = _answered(lambda: client.get(metadata.userinfo_endpoint).raise_for_status().json())
                if not isinstance(more, dict) or more.get("sub") != claims["sub"]:
                    raise SignInRefused("not_valid", "the user info is about somebody else")
                claims = {**more, **claims}
        return claims

    def sign_out_address(self, back: str) -> str | None:
        """The sign-out address of the provider (OpenID Connect RP-Initiated Logout 1.0); None if it has none.

        :param back: address that it redirects the browser to afterwards
        """
        with self._client(back) as client:
            end = self._metadata(client).end_session_endpoint
        if end is None:
            return None
        from httpx2 import URL  # imported here, as in `_client`

        query = {"client_id": self._settings.client_id, "post_logout_redirect_uri": back}
        return str(URL(end).copy_merge_params(query))

    def _client(self, redirect_uri: str) -> Any:
        # Imported here: only stations with a provider need these modules.
        from authlib.integrations.httpx_client import OAuth2Client

        return OAuth2Client(
            self._settings.client_id,
            self._secret,
            scope=self._settings.scope,
            redirect_uri=redirect_uri,
            code_challenge_method="S256",
            timeout=TIMEOUT_S,
        )

    def _metadata(self, client: Any) -> _Metadata:
        address = f"{self._settings.issuer.rstrip('/')}/.well-known/openid-configuration"
        try:
            metadata = _Metadata.model_validate_json(_answered(lambda: _got(client, address).content))
        except ValidationError as error:
            raise SignInRefused("unreachable", f"{address} is no provider: {error}") from error
        if metadata.issuer != self._settings.issuer:
            text = f"the provider calls itself {metadata.issuer}, the station file {self._settings.issuer}"
            raise SignInRefused("not_valid", text)
        return metadata

    def _checked(self, token: Mapping[str, Any], keys: Any, nonce: str) -> Mapping[str, Any]:
        """Claims of the ID token (OpenID Connect Core 1.0, section 3.1.3.7)."""
        from joserfc import jwt
        from joserfc.errors import JoseError
        from joserfc.jwk import KeySet

        client_id = self._settings.client_id
        wanted = jwt.JWTClaimsRegistry(
            leeway=_LEEWAY_S,
            iss={"essential": True, "value": self._settings.issuer},
            aud={"essential": True, "value": client_id},
            nonce={"essential": True, "value": nonce},
            exp={"essential": True},
            iat={"essential": True},
            sub={"essential": True},
        )
        try:
            found = jwt.decode(str(token["id_token"]), KeySet.import_key_set(keys), algorithms=ALGORITHMS)
            wanted.validate(found.claims)
        except (JoseError, ValueError, KeyError, TypeError) as error:
            raise SignInRefused("not_valid", f"ID token: {type(error).__name__} {error}") from error
        if found.claims.get("azp", client_id) != client_id:
            raise SignInRefused("not_valid", "the ID token is for another client")
        return dict(found.claims)


def claim(claims: Mapping[str, Any], name: str) -> Any:
    """A claim by its name, or nested in another: `realm_access.roles`; None if it is missing."""
    if name in claims:
        return claims[name]
    outer, _, inner = name.partition(".")
    return claim(claims[outer], inner) if inner and isinstance(claims.get(outer), dict) else None


def _got(client: Any, address: str) -> Any:
    """A request without the access token, which must not be sent there."""
    return client.request("GET", address, withhold_token=True).raise_for_status()


def _answered(request: Callable[[], Any]) -> Any:
    from authlib.integrations.base_client import OAuthError
    from httpx2 import HTTPError, InvalidURL

    try:
        return request()
    except OAuthError as error:
        raise SignInRefused("not_valid", f"the provider says {error}") from error
    except (HTTPError, InvalidURL, ValueError) as error:
        raise SignInRefused("unreachable", f"{type(error).__name__}: {error}") from error


def _secret(settings: OpenIdSettings) -> str | None:
    path = settings.client_secret_file
    if path is None:
        return None
    try:
        return path.read_text(encoding="utf-8").strip()
    except (OSError, UnicodeDecodeError) as error:
        raise InputRefused(f"The secret of [openid], {path}, cannot be read: {error}.") from error
