import { notice } from "../scanned";

/** What the last scan led to; it stays until the next one. */
export function ScanNotice() {
  const said = notice.value;
  return (
    <p class={`scan ${said?.refused ? "alarm warn" : ""}`} role="alert" hidden={!said}>
      {said && (said.refused ? `◆ ${said.text}` : said.text)}
    </p>
  );
}
