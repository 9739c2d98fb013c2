// The slider of each pair of pictures moves the edge between them.
document.addEventListener("DOMContentLoaded", () => {
  for (const pair of document.querySelectorAll(".before-after")) {
    const slider = pair.querySelector("input");
    const move = () => pair.style.setProperty("--cut", `${slider.value}%`);
    slider.addEventListener("input", move);
    move();
  }
});
