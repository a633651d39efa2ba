"use strict";
// Tables sort by their heads and are copied as tab-separated values. A column whose cells hold errors is copied as two.
(() => {
    const words = document.body.dataset;
    const collator = new Intl.Collator(document.documentElement.lang, { numeric: true });
    const text = (cell) => cell.textContent.replace(/\s+/g, " ").trim();
    const is_blank = (cell) => ["", "–"].includes(text(cell));

    // The number that a cell begins with; none where there is none.
    const number = (cell) => {
        const found = text(cell).match(/^[+-]?\d+(?:[.,]\d+)?(?:e[+-]?\d+)?/);
        return found ? Number(found[0].replace(",", ".")) : NaN;
    };

    const cells_of = (rows, column) => rows.map((row) => row.cells[column]);

    const sort = (table, column, way, first) => {
        const body = table.tBodies[0];
        const known = cells_of(first, column).filter((cell) => !is_blank(cell));
        const are_numbers = known.every((cell) => !Number.isNaN(number(cell)));
        const compare = (a, b) => (are_numbers ? number(a) - number(b) : collator.compare(text(a), text(b)));
        const sorted = way === "none" ? first : [...first].sort((a, b) => {
            const [x, y] = [a.cells[column], b.cells[column]];
            // What is not known stays below.
            if (is_blank(x) || is_blank(y)) return Number(is_blank(x)) - Number(is_blank(y));
            return way === "ascending" ? compare(x, y) : compare(y, x);
        });
        body.append(...sorted);
    };

    const make_sortable = (table) => {
        const heads = [...table.tHead.rows[0].cells];
        const first = [...table.tBodies[0].rows];
        heads.forEach((head, column) => {
            const button = document.createElement("button");
            button.type = "button";
            button.title = words.sort.replace("{column}", text(head));
            button.append(...head.childNodes);
            head.append(button);
            head.setAttribute("aria-sort", "none");
            button.addEventListener("click", () => {
                const next = { none: "ascending", ascending: "descending", descending: "none" };
                const way = next[head.getAttribute("aria-sort")];
                heads.forEach((other) => other.setAttribute("aria-sort", other === head ? way : "none"));
                sort(table, column, way, first);
            });
        });
    };

    // A column as it is copied: itself, or values with their unit beside errors.
    const copied_column = (head, cells) => {
        const parts = cells.map((cell) => text(cell).match(/^(\S+) ± (\S+)(?: (.*))?$/));
        if (!parts.some(Boolean)) return [[text(head), ...cells.map(text)]];
        const unit = parts.find(Boolean)[3];
        const name = unit ? `${text(head)}, ${unit}` : text(head);
        const plain = (cell) => (unit ? text(cell).replace(new RegExp(` ${unit}$`), "") : text(cell));
        return [
            [name, ...cells.map((cell, row) => (parts[row] ? parts[row][1] : plain(cell)))],
            [`±`, ...parts.map((part) => (part ? part[2] : ""))],
        ];
    };

    const as_values = (table) => {
        const rows = [...table.tBodies[0].rows, ...(table.tFoot ? table.tFoot.rows : [])];
        const columns = [...table.tHead.rows[0].cells].flatMap((head, column) => copied_column(head, cells_of(rows, column)));
        return columns[0].map((_, row) => columns.map((column) => column[row]).join("\t")).join("\n") + "\n";
    };

    const copy = async (values) => {
        if (navigator.clipboard && window.isSecureContext) return navigator.clipboard.writeText(values);
        const area = document.createElement("textarea");
        area.value = values;
        document.body.append(area);
        area.select();
        document.execCommand("copy");
        area.remove();
        return undefined;
    };

    const make_copyable = (table) => {
        const button = document.createElement("button");
        button.type = "button";
        button.className = "copy";
        button.textContent = words.copy;
        const told = document.createElement("span");
        told.setAttribute("role", "status");
        button.addEventListener("click", async () => {
            await copy(as_values(table));
            told.textContent = words.copied;
            setTimeout(() => { told.textContent = ""; }, 2000);
        });
        const line = document.createElement("p");
        line.className = "tools";
        line.append(button, told);
        table.parentElement.before(line);
    };

    for (const table of document.querySelectorAll("table")) {
        make_sortable(table);
        make_copyable(table);
    }
})();
