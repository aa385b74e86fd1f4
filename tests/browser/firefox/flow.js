// An operator's way from the scan to the certificate in Firefox, over WebDriver BiDi.
// node flow.js FIREFOX URL: prints what was seen as JSON; fails at the step that did not happen.
import { launch } from "puppeteer-core";

const [executablePath, url] = process.argv.slice(2);
const LIMIT_MS = 30_000;
const SCANNER_MS = 5;
const HOLD_MS = 1200;
const NO_PROXY = 1;
const CLOSED_PORT = 9;
// whatever is not for this computer finds a closed port
const ONLY_HERE = {
  "network.proxy.type": NO_PROXY,
  "network.proxy.http": "127.0.0.1",
  "network.proxy.http_port": CLOSED_PORT,
  "network.proxy.ssl": "127.0.0.1",
  "network.proxy.ssl_port": CLOSED_PORT,
  "network.proxy.no_proxies_on": "127.0.0.1",
};

const browser = await launch({ browser: "firefox", executablePath, extraPrefsFirefox: ONLY_HERE });
try {
  const page = await browser.newPage();
  page.setDefaultTimeout(LIMIT_MS);
  const errors = [];
  page.on("pageerror", (error) => errors.push(String(error)));
  await page.setViewport({ width: 1024, height: 768 });

  const shows = (selector, text) =>
    page.waitForFunction(
      (selector, text) => document.querySelector(selector)?.innerText.includes(text),
      {},
      selector,
      text,
    );
  const press = async (button) => {
    await page.locator(`::-p-aria([name="${button}"][role="button"])`).click();
    await page.locator(".confirm:not([hidden]) .hold").click({ delay: HOLD_MS });
  };
  const scan = async (code) => {
    await page.keyboard.type(code, { delay: SCANNER_MS });
    await page.keyboard.press("Enter");
  };

  await page.goto(url);
  await shows("header", "connected");
  await scan("BADGE:Ada");
  await scan("FB-1");
  await scan("FB-7");
  const scanned = await page.$$eval("form input", (fields) => fields.map((field) => field.value));
  await press("Calibrate");
  await shows(".outcome", "FB-7");
  await page.locator(".outcome a[href^='/result/']").click();
  await shows(".next-step", "Apply to drives");
  const decision = await page.$eval(".decision", (line) => line.innerText);
  await page.waitForSelector(".maps .field-map");
  await press("Apply to drives");
  await shows(".summary", "Verified");
  const certificate = await page.$eval("a[href*='certificate.html']", (link) => link.href);
  const said = [...errors]; // Firefox notes that the certificate allows no icon
  await page.goto(certificate);
  await shows("h1", "certificate");
  const title = await page.$eval("h1", (heading) => heading.innerText);
  console.log(JSON.stringify({ version: await browser.version(), scanned, decision, title, errors: said }));
} finally {
  await browser.close();
}
