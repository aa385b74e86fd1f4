/** The frame: a header that never scrolls away, and one view below it. */
import { Header } from "./parts/header";
import { path } from "./router";
import { DiagnosisView } from "./views/diagnosis/diagnosis";
import { HistoryView } from "./views/history/history";
import { ResultView } from "./views/result/result";
import { StationView } from "./views/station/station";

export function App() {
  return (
    <>
      <Header />
      <main>
        <View />
      </main>
    </>
  );
}

function View() {
  const [, view, id] = path.value.split("/");
  if (view === "history") return <HistoryView />;
  if (view === "diagnosis") return <DiagnosisView id={Number(id)} />;
  if (view === "result") return <ResultView id={id ? Number(id) : null} />;
  return <StationView />;
}
