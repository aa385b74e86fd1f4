/** The frame: a header that does not scroll, and one view below it. */
import { useEffect, useRef } from "preact/hooks";
import { followHeading } from "./heading";
import { t } from "./messages";
import { Header } from "./parts/header";
import { useLoaded } from "./parts/load";
import { path } from "./router";
import { badge, session } from "./session";
import { DiagnosisView } from "./views/diagnosis/diagnosis";
import { HistoryView } from "./views/history/history";
import { ResultView } from "./views/result/result";
import { SignInView } from "./views/sign-in/sign-in";
import { StationView } from "./views/station/station";

export function App() {
  const main = useRef<HTMLElement>(null);
  useEffect(() => (main.current ? followHeading(main.current) : undefined), []);
  return (
    <>
      <Header />
      <main ref={main}>
        <View />
      </main>
    </>
  );
}

function View() {
  if (session.value === null || badge.value !== null) return <SignInView />;
  const [, view, id] = path.value.split("/");
  if (view === "history") return <HistoryView />;
  if (view === "maintenance") return <Maintenance />;
  if (view === "diagnosis") return <DiagnosisView id={Number(id)} />;
  if (view === "result") return <ResultView id={id ? Number(id) : null} />;
  return <StationView />;
}

/** Loaded when it is needed, not with the page. */
function Maintenance() {
  const { value: view, trouble } = useLoaded("", () => import("./views/maintenance/maintenance")).value;
  if (view) return <view.MaintenanceView />;
  return <p class="panel empty">{trouble === null ? t.shared.loading : t.refusals.noAnswer}</p>;
}
