/** Who signs in, and which programs have keys. */
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
