"""Print every benchmark, ratios to peers measured in the same run: `python -m benchmarks`."""

from benchmarks import clocks, commands, design, identification, optimal, robust, running


def main() -> None:
    """Run every benchmark."""
    for part in (design, robust, optimal, running, clocks, identification, commands):
        for text in part.report():
            print(text)


if __name__ == "__main__":
    main()
