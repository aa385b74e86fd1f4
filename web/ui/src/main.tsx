import { render } from "preact";
import { App } from "./app";
import { connect } from "./live";
import { t } from "./messages";
import { watchSession } from "./session";

document.documentElement.lang = t.language;
document.title = t.title;
connect();
watchSession();
render(<App />, document.getElementById("app")!);
