/** Asks for the station's state before the texts of the page are there: both are on their way at once. */
import { connect } from "./live";

connect();
