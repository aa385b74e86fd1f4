/** Requests the station's state before the texts of the page are loaded: both are loaded at the same time. */
import { connect } from "./live";

connect();
