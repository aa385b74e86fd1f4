import "./feed";
import { render } from "preact";
import { App } from "./app";
import { watchArmed } from "./armed";
import { t } from "./messages";
import { scanned, watchScans } from "./scanned";
import { listen } from "./scanner";
import { watchSession } from "./session";

document.documentElement.lang = t.language;
document.title = t.title;
watchSession();
watchArmed();
watchScans();
listen(scanned);
render(<App />, document.getElementById("app")!);
