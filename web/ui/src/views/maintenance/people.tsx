/** Users who sign in, and keys of programs. */
import { Needs } from "./allowed";
import { Keys } from "./keys";
import { Users } from "./users";

export function PeoplePart() {
  return (
    <Needs permission="administer">
      <Users />
      <Keys />
    </Needs>
  );
}
