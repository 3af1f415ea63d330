(function () {
  "use strict";
  const form = document.getElementById("ask");
  if (!form) return;
  const data = JSON.parse(document.getElementById("distance-data").textContent);
  const toe = {{ toe }}, sometimes = {{ sometimes | tojson }};
  const input = document.getElementById("distance"), told = document.getElementById("told");
  function tell() {
    const distance = parseFloat(input.value);
    document.getElementById("place").textContent = isFinite(distance) ? String(+(toe + distance).toPrecision(4)) : "?";
    if (!(distance >= 0)) { told.textContent = "Enter a distance of 0 m or more."; return; }
    let k = 0;
    while (k + 1 < data.distance.length && data.distance[k + 1] <= distance) k += 1;
    told.textContent = data.all[k] + (sometimes ? "; if it slides " + data.sliding[k] : "");
  }
  form.hidden = false;
  input.value = String(+data.distance[Math.floor(data.distance.length / 2)].toPrecision(3));
  input.addEventListener("input", tell);
  form.addEventListener("submit", (event) => event.preventDefault());
  tell();
})();
