/** The permissions of a role here; a missing permission is stated, not hidden. */
import type { ComponentChildren } from "preact";
import { t } from "../../messages";
import { session } from "../../session";
import type { Role } from "../../types";

export const ROLES = {
  operate: ["operator", "engineer", "administrator"],
  maintain: ["engineer", "administrator"],
  administer: ["administrator"],
} satisfies Record<string, Role[]>;
export type Permission = keyof typeof ROLES;

export function may(permission: Permission): boolean {
  const role = session.value?.role;
  return role != null && (ROLES[permission] as Role[]).includes(role);
}

export function Needs({ permission, children }: { permission: Permission; children: ComponentChildren }) {
  if (may(permission)) return <>{children}</>;
  if (session.value === undefined) return <p class="empty">{t.shared.loading}</p>;
  const roles = t.maintenance.either(ROLES[permission].map((role) => t.maintenance.roles[role]));
  const mine = session.value?.role;
  return (
    <p class="note">
      ◆ {t.maintenance.needs(roles, mine ? t.maintenance.roles[mine] : t.maintenance.nobody)}
    </p>
  );
}
