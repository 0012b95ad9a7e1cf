// A link into a folded part unfolds it.
function unfold() {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  for (let part = target; part; part = part.parentElement) if (part.tagName === "DETAILS") part.open = true;
  if (target) target.scrollIntoView();
}
addEventListener("hashchange", unfold);
addEventListener("DOMContentLoaded", unfold);
// The contents stand beside the page where it is wide, and are folded where it is narrow.
const wide = matchMedia("(min-width: 72rem)");
const contents = document.querySelector(".contents details");
const show = () => { contents.open = wide.matches; };
wide.addEventListener("change", show);
show();
