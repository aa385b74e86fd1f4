import { render } from "preact";
import { App } from "./app";
import { connect } from "./live";
import { t } from "./messages";

document.documentElement.lang = t.language;
document.title = t.title;
connect();
render(<App />, document.getElementById("app")!);
