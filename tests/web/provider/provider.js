// A certified OpenID Connect provider (npm: oidc-provider) on loopback, with people of its own.
// node provider.js REDIRECT_URI SIGNED_OUT_URI: prints its issuer.
import { createServer } from "node:http";
import { Provider } from "oidc-provider";

const [redirectUri, signedOutUri] = process.argv.slice(2);
const PEOPLE = {
  ada: { preferred_username: "Ada", groups: ["everybody", "station-operators", "station-admins"] },
  bo: { preferred_username: "Bo", groups: ["station-operators"] },
  eve: { preferred_username: "Eve", groups: ["everybody"] },
  odd: { preferred_username: "<b>odd</b>", groups: ["station-operators"] },
};

const server = createServer();
server.listen(0, "127.0.0.1", () => {
  const issuer = `http://127.0.0.1:${server.address().port}`;
  const provider = new Provider(issuer, {
    clients: [
      {
        client_id: "station",
        token_endpoint_auth_method: "none",
        redirect_uris: [redirectUri],
        post_logout_redirect_uris: [signedOutUri],
      },
      {
        client_id: "station-with-a-secret",
        client_secret: "a-secret-of-thirty-two-characters",
        redirect_uris: [redirectUri],
      },
    ],
    claims: { openid: ["sub"], profile: ["preferred_username", "groups"] },
    cookies: { keys: ["only for tests"] },
    features: { devInteractions: { enabled: true }, rpInitiatedLogout: { enabled: true } },
    findAccount: (_, id) => ({ accountId: id, claims: () => ({ sub: id, ...PEOPLE[id] }) }),
    pkce: { required: () => true },
  });
  server.on("request", provider.callback());
  console.log(issuer);
});
