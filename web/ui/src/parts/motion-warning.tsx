import { t } from "../messages";

/** Before anything moves: which robot, over what or with what consequence, and that nobody may be near. */
export function MotionWarning({ serial, then = "." }: { serial: string; then?: string }) {
  return (
    <>
      <strong>{t.shared.willMove(serial)}</strong>
      {then} {t.shared.clear}
    </>
  );
}
