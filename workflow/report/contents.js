// The contents stand beside the page where it is wide, and are folded where it is narrow.
const wide = matchMedia("(min-width: 72rem)");
const contents = document.querySelector(".contents details");
const show = () => { contents.open = wide.matches; };
wide.addEventListener("change", show);
show();
