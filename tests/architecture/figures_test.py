"""Compares the figures that README.md and docs/physics.md quote with the tables they come from.

Usage: figures_test.py SOURCE_DIR
"""
import pathlib
import re
import sys

NUMBER = r"([\de.-]+)"


def row_of_orders(event):
    """The default's median errors at 60 Hz and their orders, as a row of docs/physics.md has them."""
    def row(ground, method, error, with_error=True):
        at_60 = r"(\S+)" if with_error else r"\S+"
        return rf"{event} +{ground} +{method} +{error}, median +\S+ +\S+ +{at_60} +(?:\S+ +){{4}}(\S+) "
    place = rf"{NUMBER} m, {NUMBER}"
    return ("docs/physics.md", rf"\| {event} \| {place} \| {place} \| {place} \| {NUMBER} \|", "lab-orders.txt", "(?s:.*?)".join((
        row("function", "standard", "place"), row("function", "standard", "way"), row("spline", "standard", "place"),
        row("spline", "precise", "place", with_error=False))))


# document, a pattern of its sentence with one group for each figure; table, a pattern of its row with as many groups.
# A figure may be rounded: it must be the table's number to the digits that are printed.
QUOTED = (
    ("README.md", r"step at ([\d.]+) ns a louse on one core by AVX-512",
     "lab-speed-steps.csv", r'"room, avx512",21,10000,([\d.]+),'),
    ("README.md", r"([\d.]+) by AVX2,", "lab-speed-steps.csv", r'"room, avx2",21,10000,([\d.]+),'),
    ("README.md", r"([\d.]+) without lanes", "lab-speed-steps.csv", r'"room, scalar",21,10000,([\d.]+),'),
    ("README.md", r"1,000 pushed lice cost ([\d.]+)\s+\(`arena`\) to ([\d.]+) ns", "lab-speed-maps.csv",
     r"arena,1000,avx512,held,yes,([\d.]+),(?s:.*?)jumps,1000,avx512,held,yes,([\d.]+),"),
    ("docs/physics.md", r"\| `hills` \| ([\d.]+) ns \| ([\d.]+) \|", "lab-speed-maps.csv",
     r"hills,1000,avx512,held,yes,([\d.]+),(?s:.*?)hills,1000,avx512,each tick,yes,([\d.]+),"),
    ("README.md", r"proven again at ([\d.]+) times real time",
     "replay-speed.txt", r"verify --jobs 1 +100 lice, 1 hour, .ndjson.zst +[\d.]+ s +([\d.]+) x real time"),
    ("README.md", r"200 bots get ([\d.]+) frames a second each",
     "swarm.txt", r"distinct ticks/s per bot +min +([\d.]+)"),
    ("README.md", r"the gaps' 99th percentile ([\d.]+) ms", "swarm.txt", r"gap between frames .* p99 +([\d.]+)"),
    ("docs/physics.md", r"300 points \| 1e-12 \| ([\de.-]+), ([\de.-]+), ([\de.-]+) \|", "lab-goals.txt",
     r"natural_document: z and gradient +([\de.-]+) (?s:.*)biquadratic: z and gradient +([\de.-]+) (?s:.*)"
     r"blended_document: z and gradient +([\de.-]+) "),
    ("docs/physics.md", r"default, 120 Hz \| 3e-7 m \| ([\de.-]+) m", "lab-goals.txt", r"nystrom4, 120 Hz +([\de.-]+)"),
    ("docs/physics.md", r"`dopri5`, 240 Hz \| 1e-9 m \| ([\de.-]+) m", "lab-goals.txt", r"dopri5, 240 Hz, mu = 0 +([\de.-]+)"),
    ("docs/physics.md", r"24 rest positions, default, 60 Hz \| 3e-6 m \| ([\de.-]+) m", "lab-goals.txt",
     r"rest positions +([\de.-]+)"),
    ("docs/physics.md", r"190 rows on its grid \| 1e-9 m \| ([\de.-]+) m", "lab-goals.txt", r"false_euler, 200 Hz +([\de.-]+)"),
    ("docs/physics.md", r"3e-5 \| ([\de.-]+); pushed ever so little, so not projected, ([\de.-]+) \|", "lab-goals.txt",
     r"120 Hz, nystrom4 +([\de.-]+) (?s:.*)not projected +([\de.-]+)"),
    ("docs/physics.md", r"`verlet_q` \| 5e-4 \| ([\de.-]+) \|", "lab-goals.txt", r"verlet_q +([\de.-]+)"),
    ("docs/physics.md", rf"\| {NUMBER} \(`wavy_pot`\) \|", "lab-local-error.csv", rf"\nwavy_pot,15,\d+,\d+,{NUMBER},"),
    ("docs/physics.md", rf"\| {NUMBER} \(`maunga_climb`\) \|", "lab-local-error.csv", rf"\nmaunga_climb,60,\d+,\d+,{NUMBER},"),
    ("docs/physics.md", rf"\(`jumps`\) \| 1.97 to {NUMBER} \|", "lab-local-error.csv", rf"\nlong_jump,1000,\d+,\d+,[\de.-]+,[\de.-]+,{NUMBER},"),
    *(row_of_orders(event) for event in (
        "none", "none, energy kept", "a wall", "a seam", "a take-off", "a landing", "along the heading, from rest",
        "from rest under friction", "a thrust that changes", "a stop", "hardly moving under friction")),
)


def rounding(figure):
    """Half of the last digit printed: 2.3e-7 stands for what is within 0.05e-7 of it."""
    digits, _, exponent = figure.partition("e")
    return 0.5001 * 10.0 ** (int(exponent or 0) - len(digits.partition(".")[2]))


def main(root):
    faults = []
    for document, sentence, table, row in QUOTED:
        text = re.sub(r"\s+", " ", (root / document).read_text())
        said = re.search(sentence, text)
        measured = re.search(row, (root / "bench" / "results" / table).read_text())
        if not said or not measured:
            faults.append(f"{document}: no figure for /{sentence}/" if not said else f"{table}: no row /{row}/")
            continue
        for quoted, exact in zip(said.groups(), measured.groups(), strict=True):
            if abs(float(quoted) - float(exact)) > rounding(quoted):
                faults.append(f"{document} says {quoted} ({said.group(0)}), bench/results/{table} says {exact}")
    linked = re.findall(r"\]\((?:\.\./)?(bench/results/[^)#]+)\)", (root / "README.md").read_text())
    for file in (root / "docs").glob("*.md"):
        linked += re.findall(r"\]\(\.\./(bench/results/[^)#]+)\)", file.read_text())
    faults += [f"{name} is linked and is not there" for name in linked if not (root / name).exists()]
    print("\n".join(faults) or f"{len(QUOTED)} sentences say what their tables say, {len(linked)} tables are there")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
