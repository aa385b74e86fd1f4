/** The REST calls of maintenance. */
import { call } from "../../api";
import type {
  ApiKey,
  AuditList,
  BackupDrill,
  BackupMade,
  Delivery,
  DeliveryList,
  DeviceDetail,
  Found,
  NewKey,
  Role,
  Training,
  User,
  Versions,
  WireList,
} from "../../types";

/** Silent devices, and a large history, take more time. */
const LONG_MS = 120_000;

const sent = (body: unknown): RequestInit => ({
  headers: { "Content-Type": "application/json" },
  body: JSON.stringify(body),
});
const patient = (): RequestInit => ({ signal: AbortSignal.timeout(LONG_MS) });

interface Items<T> {
  items: T[];
}

export const devices = () => call<Items<DeviceDetail>>("GET", "/devices");
export const examine = () => call<Found>("POST", "/doctor", patient());
export const wire = (run: number, cursor: number) =>
  call<WireList>("GET", `/calibrations/${run}/wire?limit=100&cursor=${cursor}`);

export const deliveries = (query: URLSearchParams) => call<DeliveryList>("GET", `/deliveries?${query}`);
export const resend = (id: number) => call<Delivery>("POST", `/deliveries/${id}/resend`);

export const backups = () => call<Items<BackupMade>>("GET", "/backups");
export const backUp = () => call<BackupMade>("POST", "/backups", patient());
export const drill = () => call<BackupDrill>("POST", "/backups/drill", patient());

export const users = () => call<Items<User>>("GET", "/users");
/** With a password, with a badge and its PIN, or with all of them. */
export interface NewUser {
  name: string;
  role: Role;
  password: string | null;
  badge: string | null;
  pin: string | null;
}
export const addUser = (user: NewUser) => call<User>("POST", "/users", sent(user));
export const removeUser = (id: number) => call<null>("DELETE", `/users/${id}`);
/** Omitted fields are unchanged. */
export interface UserChange {
  role?: Role;
  disabled?: boolean;
  password?: string;
  badge?: string;
  pin?: string;
  remove_badge?: boolean;
}
export const changeUser = (id: number, change: UserChange) =>
  call<User>("PATCH", `/users/${id}`, sent(change));
export const keys = () => call<Items<ApiKey>>("GET", "/keys");
export const addKey = (key: { name: string; role: Role; days: number | null }) =>
  call<NewKey>("POST", "/keys", sent(key));
export const revokeKey = (id: number) => call<ApiKey>("DELETE", `/keys/${id}`);

export const audit = (query: URLSearchParams) => call<AuditList>("GET", `/audit?${query}`);
export const versions = () => call<Versions>("GET", "/versions");

const DESK = "/emulator/training";
export const training = () => call<Training>("GET", DESK);
export const choose = (exercise: { kind: string; joint: number | null; size: number | null }) =>
  call<Training>("POST", DESK, sent(exercise));
export const draw = () => call<Training>("POST", `${DESK}/draw`, sent({ groups: ["catalogue", "unnamed"] }));
export const reveal = () => call<Training>("POST", `${DESK}/reveal`);
export const repair = () => call<Training>("POST", `${DESK}/repair`);
