(function () {
  "use strict";
  const box = document.getElementById("films");
  if (!box) return;
  const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const films = JSON.parse(document.getElementById("film-data").textContent).map((film, number) => ({
    ...film,
    places: new Int16Array(bytes(film.places).buffer),
    shapes: new Int8Array(bytes(film.shapes).buffer),
    levels: bytes(film.levels),
    surfaces: new Int16Array(bytes(film.surfaces).buffer),
    element: box.querySelectorAll(".film")[number],
  }));
  const controls = box.querySelector(".controls"), slider = controls.querySelector("input"), play = controls.querySelector("button");
  const frames = films[0].captions.length;

  function area(film, p) {
    const x = film.places[2 * p], y = film.places[2 * p + 1], size = film.half / {{ film_shape }};
    const [xx, xy, yx, yy] = [0, 1, 2, 3].map((k) => size * film.shapes[4 * p + k]);
    const corner = (a, b) => Math.round(x + a * xx + b * xy) + " " + Math.round(y + a * yx + b * yy);
    const side = {{ film_gap }} * Math.sqrt(Math.abs(xx * yy - xy * yx)), square = side.toFixed(0);
    const below = "M" + Math.round(x - side) + " " + Math.round(y - side) + "h" + 2 * square + "v" + 2 * square + "h" + -2 * square + "z";
    return below + "M" + corner(-1, -1) + "L" + corner(1, -1) + "L" + corner(1, 1) + "L" + corner(-1, 1) + "z";
  }
  function draw(film, frame) {
    const n = film.levels.length / frames, paths = Array.from({ length: {{ film_levels }} }, () => []);
    for (let p = frame * n; p < (frame + 1) * n; p += 1) paths[film.levels[p]].push(area(film, p));
    paths.forEach((path, level) => film.element.querySelector(".level-" + level).setAttribute("d", path.join("")));
    const surface = film.x.map((x, k) => x + " " + film.surfaces[frame * film.x.length + k]);
    film.element.querySelector(".surface").setAttribute("d", "M" + surface.join("L"));
    film.element.querySelector("figcaption").textContent = film.captions[frame];
  }
  const show = () => films.forEach((film) => draw(film, Number(slider.value)));
  let timer = null;
  function stop() { clearInterval(timer); timer = null; play.textContent = "Play"; }
  function step() {
    if (Number(slider.value) >= frames - 1) { stop(); return; }
    slider.value = Number(slider.value) + 1;
    show();
  }
  play.addEventListener("click", () => {
    if (timer) { stop(); return; }
    if (Number(slider.value) >= frames - 1) slider.value = 0;
    play.textContent = "Pause";
    timer = setInterval(step, 200);
  });
  slider.max = frames - 1;
  slider.value = frames - 1;
  slider.addEventListener("input", () => { stop(); show(); });
  controls.hidden = false;
})();
