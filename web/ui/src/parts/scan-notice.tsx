import { notice } from "../scanned";

/** The result of the last scan, shown until the next one. */
export function ScanNotice() {
  const said = notice.value;
  return (
    <p class={`scan ${said?.refused ? "alarm warn" : ""}`} role="alert" hidden={!said}>
      {said && (said.refused ? `◆ ${said.text}` : said.text)}
    </p>
  );
}
