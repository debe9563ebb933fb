"use strict";
(() => {
  const element = (id) => document.getElementById(id);
  const [player, picture, absent, play, scrub, number, facts] =
    ["player", "picture", "absent", "play", "scrub", "number", "facts"].map(element);
  const links = [...document.querySelectorAll("#grid a")];
  const bars = [...document.querySelectorAll("#bars a")];
  const titles = [...document.querySelectorAll("#frames thead th")].map((cell) => cell.textContent);
  const fps = Number(player.dataset.fps);
  // Not every frame has a link: long gaps have none.
  const frameOf = (index) => links[index].dataset.frame;
  let current = 0; // Counted from 0, as the links are.
  let playing = null; // When and with which frame playing began.
  let waiting = 0;

  // What the table's row says of the frame, without what does not exist.
  const describe = (row) => {
    facts.replaceChildren();
    [...row.cells].forEach((cell, i) => {
      const text = cell.dataset.short ?? cell.textContent;
      if (i === 0 || text === "–") return;
      const name = document.createElement("dt");
      const value = document.createElement("dd");
      name.textContent = titles[i];
      value.textContent = text;
      const pair = document.createElement("div");
      pair.append(name, value);
      facts.append(pair);
    });
  };

  const show = (index) => {
    for (const list of [links, bars]) list[current]?.removeAttribute("aria-current");
    links[current].tabIndex = -1;
    current = Math.min(Math.max(index, 0), links.length - 1);
    for (const list of [links, bars]) list[current]?.setAttribute("aria-current", "true");
    links[current].tabIndex = 0;
    const small = links[current].querySelector("img");
    const state = links[current].querySelector(".state").textContent;
    picture.hidden = !small;
    absent.hidden = Boolean(small);
    const frame = frameOf(current);
    absent.textContent = `frame ${frame}: ${state}`;
    if (small) picture.src = small.src;
    picture.alt = `frame ${frame}`;
    scrub.value = current + 1;
    scrub.setAttribute("aria-valuetext", `frame ${frame}, ${state}`);
    number.textContent = `frame ${frame} of ${player.dataset.frames}`;
    describe(element(`frame-${frame}`));
    clearTimeout(waiting);
    if (playing === null) waiting = setTimeout(sharpen, 120);
  };

  // Puts the full picture in place of the small one, if it can be read and is still wanted.
  const sharpen = () => {
    const wanted = current;
    const full = links[wanted].dataset.full;
    if (!full) return;
    const image = new Image();
    image.onload = () => {
      if (wanted === current && playing === null) picture.src = image.src;
    };
    image.src = full;
  };

  const step = (now) => {
    if (playing === null) return;
    playing.at ??= now;
    const frame = playing.from + Math.floor(((now - playing.at) * fps) / 1000);
    if (frame % links.length !== current) show(frame % links.length);
    requestAnimationFrame(step);
  };

  const set = (on) => {
    playing = on ? { from: current } : null;
    play.textContent = on ? "Pause" : "Play";
    if (on) requestAnimationFrame(step);
    show(current);
  };

  const go = (index) => {
    if (playing !== null) set(false);
    show(index);
  };

  play.addEventListener("click", () => set(playing === null));
  scrub.addEventListener("input", () => go(Number(scrub.value) - 1));
  for (const list of [links, bars]) list.forEach((link, index) => {
    link.addEventListener("click", (event) => {
      if (event.ctrlKey || event.metaKey || event.shiftKey) return;
      event.preventDefault();
      go(index);
      player.scrollIntoView({ block: "nearest" });
      scrub.focus({ preventScroll: true });
    });
  });
  document.addEventListener("keydown", (event) => {
    const { key, target } = event;
    if (event.altKey || event.ctrlKey || event.metaKey || event.shiftKey) return;
    if (target.closest(".scroll, details")) return;
    const inside = player.contains(target);
    const to = {
      ArrowLeft: current - 1,
      ArrowRight: current + 1,
      Home: inside ? 0 : null,
      End: inside ? links.length - 1 : null,
    }[key];
    if (to !== undefined && to !== null) {
      event.preventDefault();
      const moved = links.includes(document.activeElement);
      go(to);
      if (moved) links[current].focus();
    } else if (key === " " && inside && target !== play) {
      event.preventDefault();
      set(playing === null);
    }
  });

  // A link to a row of the table is one to its frame here.
  const follow = () => {
    const frame = location.hash.match(/^#frame-(\d+)$/)?.[1];
    const index = links.findIndex((link) => link.dataset.frame === frame);
    if (index < 0) return;
    go(index);
    player.scrollIntoView();
  };

  for (const link of links) link.tabIndex = -1;
  player.hidden = false;
  show(0);
  follow();
  addEventListener("load", follow);
  addEventListener("hashchange", follow);
})();
