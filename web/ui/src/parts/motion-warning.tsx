import { t } from "../messages";

/** Warning before any motion: which robot, its range or consequence, and that nobody may be near. */
export function MotionWarning({ serial, then = "." }: { serial: string; then?: string }) {
  return (
    <>
      <strong>{t.shared.willMove(serial)}</strong>
      {then} {t.shared.clear}
    </>
  );
}
