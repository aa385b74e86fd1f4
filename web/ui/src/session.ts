/** The user signed in at this page; null if nobody is, undefined before the station has answered. */
import { signal } from "@preact/signals";
import * as api from "./api";
import { operator } from "./operator";
import type { SignedIn } from "./types";

const LOOK_MS = 10_000;

export const session = signal<SignedIn | null | undefined>(undefined);
/** A scanned badge that waits for its PIN; the signed-in user is unchanged until then. */
export const badge = signal<string | null>(null);

function begin(known: SignedIn): void {
  session.value = known;
  if (known.via === "user") operator.value = known.name;
}

/** Query now and at intervals: a session can end by itself. */
export function watchSession(): void {
  void look();
  setInterval(() => void look(), LOOK_MS);
}

async function look(): Promise<void> {
  try {
    begin(await api.session());
  } catch (error) {
    // a station that does not answer gives no information on the session
    if (error instanceof api.Refused && error.status === 401) session.value = null;
  }
}

export async function signIn(name: string, password: string): Promise<void> {
  begin(await api.signIn({ name, password }));
}

/** Sign in the owner of the scanned badge, in place of the previous user. */
export async function signInByBadge(pin: string): Promise<void> {
  begin(await api.signInByBadge({ badge: badge.peek() ?? "", pin }));
  badge.value = null;
}

/** With the secret of the link that the station printed at its first start. */
export async function makeFirst(secret: string, name: string, password: string): Promise<void> {
  begin(await api.firstAdministrator({ secret, name, password }));
}

/** Address of the sign-in at the plant's provider, if it has a name. */
export const PROVIDER = "/api/v1/session/openid";

/** A user signed in by the plant's provider is signed out there as well. */
export async function signOut(): Promise<void> {
  const next = session.peek()?.sign_out_at;
  await api.signOut();
  session.value = null;
  if (next) location.assign(next);
}
