/** The REST calls, the same that the MES uses. */
import { attendance } from "./attended";
import { stationTime } from "./live";
import { t } from "./messages";
import { loadPhrases } from "./messages/phrases";
import { said } from "./messages/said";
import { phraseText } from "./phrase";
import type {
  Calibration,
  CalibrationBody,
  CalibrationList,
  Diagnosis,
  ErrorMap,
  PlanDocument,
  Problem,
  Quality,
  RefusedScan,
  ResidualList,
  Robot,
  ScanCodes,
  Separating,
  SignedIn,
  SignInWays,
  Solution,
  Station,
  Stopped,
  Summary,
  Target,
  TaughtPosition,
  TranslatedList,
  Trend,
} from "./types";

const TIMEOUT_MS = 8000;
/** Longer than the service itself waits for the drives. */
const STOP_TIMEOUT_MS = 4000;

/** The error, in words for the operator. */
export class Refused extends Error {
  constructor(
    message: string,
    readonly field: string | null = null,
    readonly status: number | null = null,
  ) {
    super(message);
  }
}

export async function call<T>(
  method: "GET" | "POST" | "PATCH" | "DELETE",
  path: string,
  options: RequestInit = {},
  accepted?: number,
): Promise<T> {
  let response: Response;
  try {
    response = await fetch(`/api/v1${path}`, {
      method,
      signal: AbortSignal.timeout(TIMEOUT_MS),
      ...options,
      headers: { ...options.headers, ...attendance() },
    });
  } catch {
    throw new Refused(t.refusals.noAnswer);
  }
  const body: unknown = await response.json().catch(() => null);
  if (!response.ok && !(accepted === response.status && body)) {
    const problem = body as Partial<Problem> | null;
    const { detail, said: phrase = null } = problem ?? {};
    if (phrase) await loadPhrases();
    throw new Refused(
      detail ? ((phrase && phraseText(phrase)) ?? said(detail)) : t.refusals.status(response.status),
      problem?.field ?? null,
      response.status,
    );
  }
  return body as T;
}

/**
 * Commands that move the machine or write to its drives: not valid after this page has shown that there is no
 * answer.
 */
function command(path: string, body: object, headers: Record<string, string> = {}): Promise<Summary> {
  const time = stationTime();
  const until = time === null ? {} : { "X-Not-After": String(Math.round(time + TIMEOUT_MS)) };
  return call<Summary>("POST", path, {
    headers: { "Content-Type": "application/json", ...until, ...headers },
    body: JSON.stringify(body),
  });
}

export const start = (body: CalibrationBody, key: string) =>
  command("/calibrations", body, { "Idempotency-Key": key });

export const plan = (name: string, serial: string) =>
  call<PlanDocument>("GET", `/plans/${name}${serial && `?robot_serial=${encodeURIComponent(serial)}`}`);

export const answer = (id: number, prompt: string, value: number | null, who: string) =>
  command(`/calibrations/${id}/answer`, { prompt, value }, { "X-Operator": encodeURIComponent(who) });

export const abort = (id: number) => call<Summary>("POST", `/calibrations/${id}/abort`);

export const apply = (id: number, operator: string, key: string) =>
  command(`/calibrations/${id}/apply`, { operator }, { "Idempotency-Key": key });

export const rollBack = (id: number, operator: string) =>
  command(`/calibrations/${id}/rollback`, { operator });

export const retract = (operator: string, key: string) =>
  command("/retract", { operator }, { "Idempotency-Key": key });

export const robot = (serial: string) => call<Robot>("GET", `/robots/${encodeURIComponent(serial)}`);

export const forget = (serial: string, who: string) =>
  call<null>("DELETE", `/robots/${encodeURIComponent(serial)}/memory`, {
    headers: { "X-Operator": encodeURIComponent(who) },
  });

/** Answer of each axis; 502 has the same body. */
export const stop = () =>
  call<Stopped>(
    "POST",
    "/stop",
    { headers: { "X-Operator": "page" }, signal: AbortSignal.timeout(STOP_TIMEOUT_MS) },
    502,
  );

export const signInWays = () => call<SignInWays>("GET", "/session/ways");
export const session = () => call<SignedIn>("GET", "/session");

export const signIn = (body: { name: string; password: string }) =>
  call<SignedIn>("POST", "/session", {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });

export const firstAdministrator = (body: { secret: string; name: string; password: string }) =>
  call<SignedIn>("POST", "/session/first", {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });

export const signInByBadge = (body: { badge: string; pin: string }) =>
  call<SignedIn>("POST", "/session", {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });

export const scanCodes = () => call<ScanCodes>("GET", "/scans");

export const refusedScan = (body: RefusedScan) =>
  call<null>("POST", "/scans/refused", {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify(body),
  });

export const signOut = () => call<null>("DELETE", "/session");

export const calibration = (id: number) => call<Calibration>("GET", `/calibrations/${id}`);

export const errorMap = (id: number) => call<ErrorMap>("GET", `/calibrations/${id}/error-map`);

export const solve = (id: number, targets: Target[]) =>
  call<Solution>("POST", `/calibrations/${id}/solve`, {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ targets }),
  });

export const translate = (
  id: number,
  taught: { positions: TaughtPosition[] } | { text: string },
  back: boolean,
) =>
  call<TranslatedList>("POST", `/calibrations/${id}/translate`, {
    headers: { "Content-Type": "application/json" },
    body: JSON.stringify({ ...taught, back }),
  });

export const calibrationHolds = async () =>
  (await call<Pick<Station, "calibration">>("GET", "/station")).calibration;

export const diagnosis = (id: number) => call<Diagnosis>("GET", `/calibrations/${id}/diagnosis`);

export const residuals = (id: number) => call<ResidualList>("GET", `/calibrations/${id}/residuals`);

export const separating = (id: number) => call<Separating>("GET", `/calibrations/${id}/separating`);

export const separate = (id: number, operator: string, key: string) =>
  command(`/calibrations/${id}/separate`, { operator }, { "Idempotency-Key": key });

export const resume = (id: number, operator: string, key: string) =>
  command(`/calibrations/${id}/resume`, { operator }, { "Idempotency-Key": key });

export const calibrations = (query: URLSearchParams) =>
  call<CalibrationList>("GET", `/calibrations?${query}`);

export const countRuns = (query: URLSearchParams) =>
  call<{ count: number; more: boolean }>("GET", `/calibrations/count?${query}`);

/** Outcomes of the newest runs of one robot, or of all. */
/** Trend of one robot, of all of one type, or of all. */
export const quality = (serial: string | null, type: string | null) =>
  call<Quality>("GET", `/quality?${chosen({ robot_serial: serial, robot_type: type })}`);

export const trend = (serial: string | null, type: string | null) =>
  call<Trend>(
    "GET",
    serial ? `/robots/${encodeURIComponent(serial)}/trend` : `/trend?${chosen({ robot_type: type })}`,
  );

const chosen = (filters: Record<string, string | null>) =>
  new URLSearchParams(Object.entries(filters).flatMap(([name, value]) => (value ? [[name, value]] : [])));

/** A separate key for each confirmed start, so that pressing again after a lost answer is still one run. */
export function newKey(): string {
  // crypto.randomUUID is missing on pages served without TLS, as in most plants
  return Array.from(crypto.getRandomValues(new Uint8Array(16)), (b) => b.toString(16).padStart(2, "0")).join(
    "",
  );
}
