// Tables are sorted by a click on a heading, or Enter on it; a second one turns the order round.
document.querySelectorAll("table").forEach(table => {
  const number = cell => { const text = cell.textContent.trim().replace(/\u2212/g, "-"); const value = parseFloat(text); return isNaN(value) ? null : value; };
  const before = (a, b, column) => {
    const x = a.cells[column], y = b.cells[column], m = number(x), n = number(y);
    if (m !== null && n !== null) return m - n;
    if (m !== null || n !== null) return m !== null ? -1 : 1; // what is missing goes to the end
    return x.textContent.localeCompare(y.textContent);
  };
  const headings = Array.from(table.querySelectorAll("thead th")), body = table.tBodies[0];
  if (!body || body.rows.length < 2) return;
  headings.forEach((heading, column) => {
    heading.tabIndex = 0;
    heading.setAttribute("aria-sort", "none");
    heading.title = "sort by this column";
    const sort = () => {
      const down = heading.getAttribute("aria-sort") === "ascending";
      const rows = Array.from(body.rows).sort((a, b) => (down ? -1 : 1) * before(a, b, column));
      headings.forEach(other => other.setAttribute("aria-sort", other !== heading ? "none" : down ? "descending" : "ascending"));
      body.append(...rows);
    };
    heading.addEventListener("click", sort);
    heading.addEventListener("keydown", event => { if (event.key === "Enter") sort(); });
  });
});
