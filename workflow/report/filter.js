const form = document.forms.filter, choices = [...form.querySelectorAll("select")];
const parts = [...document.querySelectorAll("[data-kind]")];
function show() {
  const aim = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const words = form.words.value.toLowerCase().split(/\s+/);
  for (const part of parts) {
    const text = `${part.id} ${part.textContent}`.toLowerCase();
    const asked = words.every((word) => text.includes(word)) &&
      choices.every(({name, value}) => !value || part.dataset[name].split("|").includes(value));
    part.hidden = !asked && !(part.closest("section") ?? part).contains(aim);
  }
  form.shown.value = `${parts.filter((part) => !part.hidden).length} of ${parts.length} ${form.dataset.parts} shown`;
  if (!aim?.closest("section, [data-kind]")) return;
  aim.querySelector("details")?.setAttribute("open", "");
  aim.scrollIntoView();
}
form.addEventListener("input", () => { history.replaceState(null, "", "#"); show(); });
addEventListener("hashchange", show);
form.hidden = false;
show();
