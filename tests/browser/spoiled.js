// What cannot be read or hit: texts over one another, over a button, cut, or beside the page; targets too small for a glove.
async () => {
  // charts follow a change of the window in the next frame
  for (let frame = 0; frame < 3; frame++) await new Promise(requestAnimationFrame);
  const CUTS = ["hidden", "clip"];
  const SLACK_PX = 2;
  const TARGET_PX = 44;
  /** Tables may be wider than the page and scroll; what is read as a sentence or pressed may not. */
  const NEVER_SCROLLED = "p, h1, h2, h3, button, a.button, label";
  const shown = (element) =>
    element.checkVisibility({ visibilityProperty: true, opacityProperty: true }) && !element.closest(".hidden");
  const short = (text) => text.trim().replace(/\s+/g, " ").slice(0, 40);
  const found = [];

  const texts = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const owner = node.parentElement;
    if (!node.data.trim() || owner.closest("script, style, select, header") || !shown(owner)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (const line of range.getClientRects()) {
      const seen = visiblePart(owner, line);
      if (seen === null) continue;
      if (typeof seen === "string") found.push(`${seen}: ${short(node.data)}`);
      else if (seen.right - seen.left > SLACK_PX) texts.push({ owner, text: short(node.data), ...seen });
    }
  }

  /** What the boxes around it leave of a line: a rectangle, null where it is scrolled away, or what is wrong. */
  function visiblePart(owner, { left, top, right, bottom }) {
    if (right - left < 1 || bottom - top < 1) return null;
    const middle = (top + bottom) / 2;
    for (let box = owner; box && box !== document.body; box = box.parentElement) {
      const style = getComputedStyle(box);
      const scrolls = /auto|scroll/.test(style.overflowX + style.overflowY);
      const cuts = CUTS.includes(style.overflowX) && !(box instanceof SVGElement && box.tagName !== "svg");
      if (!scrolls && !cuts) continue;
      const edge = box.getBoundingClientRect();
      if (scrolls && (middle < edge.top || middle > edge.bottom || left > edge.right || right < edge.left)) return null;
      const beyond = Math.max(edge.left - left, right - edge.right, edge.top - top - 3, bottom - edge.bottom - 3);
      if (cuts && !scrolls && beyond > SLACK_PX) return "cut";
      if (scrolls && right > edge.right + SLACK_PX && owner.closest(NEVER_SCROLLED) && !owner.closest("thead")) return "scrolled aside";
      [left, right] = [Math.max(left, edge.left), Math.min(right, edge.right)];
    }
    return right > document.documentElement.clientWidth + 1 || left < -1 ? "beside the page" : { left, top, right, bottom };
  }

  const over = (a, b) => {
    const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
    const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    return wide > SLACK_PX && high > 0.4 * Math.min(a.bottom - a.top, b.bottom - b.top);
  };
  texts.forEach((a, index) => {
    for (const b of texts.slice(index + 1)) {
      if (over(a, b) && !(a.owner === b.owner && a.text === b.text)) found.push(`over one another: ${a.text} | ${b.text}`);
    }
  });
  for (const control of document.querySelectorAll("main :is(button, input, select, a.button)")) {
    if (!shown(control)) continue;
    const box = control.getBoundingClientRect();
    for (const text of texts) {
      if (!control.contains(text.owner) && over(text, box)) found.push(`over a button or field: ${text.text}`);
    }
    if (control.tagName === "BUTTON" && control.scrollWidth > control.clientWidth + SLACK_PX) {
      found.push(`wider than its button: ${short(control.innerText)}`);
    }
  }
  for (const target of document.querySelectorAll("button, a, summary, select, input, textarea")) {
    if (!shown(target) || target.closest("p")) continue; // a link in a sentence is as high as its line
    const { width, height } = target.closest("label")?.getBoundingClientRect() ?? target.getBoundingClientRect();
    if (Math.min(width, height) < TARGET_PX - 0.5) {
      found.push(`too small to hit, ${Math.round(width)} x ${Math.round(height)}: ${short(target.innerText || target.id)}`);
    }
  }
  return [...new Set(found)];
}
