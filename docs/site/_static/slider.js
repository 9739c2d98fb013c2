// The slider of each pair of pictures moves the edge between them.
document.addEventListener("DOMContentLoaded", () => {
  for (const pair of document.querySelectorAll(".before-after")) {
    const slider = pair.querySelector("input");
    const move = () => pair.style.setProperty("--cut", `${slider.value}%`);
    slider.addEventListener("input", move);
    move();
  }
});

// On paper the folded answers are open.
addEventListener("beforeprint", () => {
  for (const folded of document.querySelectorAll("details:not([open])")) {
    folded.open = true;
    folded.dataset.folded = "";
  }
});
addEventListener("afterprint", () => {
  for (const opened of document.querySelectorAll("details[data-folded]")) {
    opened.open = false;
    delete opened.dataset.folded;
  }
});
