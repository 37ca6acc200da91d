#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The vtkIsosurfaceRayTracing developers
# SPDX-License-Identifier: BSD-3-Clause
"""Write the results of vtkIsosurfaceSpeedAgainstError into Documentation/accuracy.md.

    xvfb-run -a document_accuracy.py report/fields report/cranium report/brain

takes the folders of its results and replaces the part of the page between the two comments that name
this program, and the pictures Documentation/images/accuracy-*.png. Check afterwards that the text
around it still holds."""

import re

from document_parts import (
    decades,
    format_cell,
    format_number,
    markdown_table,
    parse_arguments,
    read_json,
    replace_part,
    write_chart,
)
from error_image import write_error_image

# The inputs with details in the page, by the beginnings of their names, and their pictures.
DETAILED = {
    "cranium": ("speed-error", "errors", "frame-silhouette", "frame-displaced", "heat"),
    "ch2better": (),
    "gyroid": ("heat",),
    "near tangent": (),
}
# Other parameters of the same methods, which the page leaves out.
LEFT_OUT = (
    r"Marmitt, N = [246]|Sampler.* (2\.0|1\.0|0\.25|0\.125) cells|Triangles of marching cubes"
)
# The smallest error on logarithmic axes, below the precision of a double.
SMALLEST_ERROR = 1e-17


def name_of(result):
    return ", ".join(filter(None, (result["method"], result["parameter"])))


def find(results, name):
    return next(result for result in results if name_of(result) == name)


def price_table(inputs):
    """The time of the default solver, and the ratios of others to it."""
    compared = {
        "rays": ("nanosecondsPerRay", ("Robust", "Single precision", "Marmitt, N = 3")),
        "pictures": ("millisecondsPerFrame", ("Robust", "Marmitt, N = 3")),
    }
    rows = []
    for measured in inputs:
        row = [measured["name"]]
        for kind, (time, names) in compared.items():
            times = [(find(measured[kind], name)[time] or {}).get("median") for name in names]
            row += [format_number(times[0])]
            row += [f"{format_number(t)} (x {t / times[0]:.2g})" if t else "" for t in times[1:]]
        rows.append(row)
    titles = ["input", "ns per ray: Robust", "Single precision", "Marmitt, N = 3"]
    return markdown_table([*titles, "ms per frame: Robust", "Marmitt, N = 3"], rows)


def result_table(kind, columns, results):
    errors = ("medianError", "p99Error", "maximumError")
    return markdown_table(
        [kind, *columns, "missed", "invented", "displaced", "median error", "p99", "max"],
        [
            [name_of(result), *(format_cell(result[name]) for name in columns.values())]
            + [str(result.get(name, "")) for name in ("missed", "invented", "displaced")]
            + [format_number(result.get(name), 2) for name in errors]
            for result in results
            if not re.fullmatch(LEFT_OUT, name_of(result))
        ],
    )


def curves_of(results, time, get_y):
    """A curve for each method, so that its colour is the same in all plots."""
    curves = {}
    for result in results:
        points = curves.setdefault(result["method"], [])
        y = get_y(result)
        if result[time] and y is not None:
            points.append((result[time]["median"], y))
    return curves


def write_speed_plot(measured, path):
    curves = curves_of(
        measured["rays"],
        "nanosecondsPerRay",
        lambda result: max(SMALLEST_ERROR, result["p99Error"]) if "p99Error" in result else None,
    )
    times = [x for points in curves.values() for x, _ in points]
    write_chart(
        path,
        f"{measured['name']}: speed against error",
        ("ns per ray, one thread", *decades(times)),
        ("error of 99 % of the rays, cells", SMALLEST_ERROR, 1000.0),
        curves,
    )


def write_share_plot(measured, path, title, names):
    """How large a share of the rays some counts are together; only of methods that have all of them."""
    # 0.3 rays stand for none, which a logarithmic axis cannot show.
    curves = curves_of(
        measured["pictures"],
        "millisecondsPerFrame",
        lambda result: max(0.3, sum(result[name] for name in names)) / measured["numberOfRays"]
        if all(name in result for name in names)
        else None,
    )
    points = [point for curve in curves.values() for point in curve]
    write_chart(
        path,
        f"{measured['name']}: {title} (lowest: none)",
        ("ms per frame, all threads", *decades([x for x, _ in points])),
        ("share of the rays", decades([y for _, y in points])[0], 1.0),
        {name: curve for name, curve in curves.items() if curve},
    )


def write_silhouette_plot(measured, path):
    write_share_plot(measured, path, "rays missed or invented", ("missed", "invented"))


def write_displacement_plot(measured, path):
    write_share_plot(measured, path, "rays displaced by more than 0.05 cells", ("displaced",))


def write_distribution_plot(measured, path):
    curves = {
        name_of(result): [
            (max(SMALLEST_ERROR, error), share) for error, share in result["errorsAndSharesAbove"]
        ]
        for result in measured["rays"]
        if "errorsAndSharesAbove" in result and result["parameter"] in ("", "N = 3", "0.5 cells")
    }
    write_chart(
        path,
        f"{measured['name']}: how many rays have which error",
        ("error, cells", SMALLEST_ERROR, 10.0),
        ("share of the rays with a larger error", 1e-4, 1.0),
        curves,
        has_markers=False,
    )


# Each picture with its caption and what writes it, of an input and to a path.
PICTURES = {
    "speed-error": ("Rays: speed against error", write_speed_plot),
    "errors": ("How many rays have which error", write_distribution_plot),
    "frame-silhouette": (
        "Whole frames: speed against rays missed or invented",
        write_silhouette_plot,
    ),
    "frame-displaced": (
        "Whole frames: speed against rays displaced along their way",
        write_displacement_plot,
    ),
    "heat": (
        "Errors of the pixels",
        lambda measured, path: write_error_image(measured["errorImage"], path),
    ),
}


def describe_input(measured, pictures, images):
    rays, hits = measured["numberOfRays"], measured["numberOfHits"]
    yield f"### {measured['name']}, isovalue {measured['isovalue']:g}\n\n"
    yield f"{rays} rays, of which {hits} meet the surface.\n\n"
    columns = {"ns per ray": "nanosecondsPerRay", "ns per cell": "nanosecondsPerCell"}
    yield result_table("rays", columns, measured["rays"])
    columns = {"ms per frame": "millisecondsPerFrame", "of it, tracing": "millisecondsTracing"}
    yield result_table("pictures", columns, measured["pictures"])
    for name in pictures:
        caption, write = PICTURES[name]
        image = f"accuracy-{name}-{re.sub('[^0-9A-Za-z]', '-', measured['name'])}.png"
        write(measured, images / image)
        yield f"![{caption}](images/{image})\n\n"


def describe(reports, images):
    for folder, report in reports.items():
        said = report["environment"]
        yield f"- {folder.name}: {said['machine']}; OpenGL by {said['OpenGL']}; load of the machine "
        yield f"before: {said['load of the machine before']}\n"
    inputs = [measured for report in reports.values() for measured in report["inputs"]]
    yield f"\nThe cost of the default solver:\n\n{price_table(inputs)}"
    for beginning, pictures in DETAILED.items():
        for measured in inputs:
            if measured["name"].startswith(beginning):
                yield from describe_input(measured, pictures, images)


def main():
    arguments = parse_arguments(__doc__, "reports+")
    reports = {folder: read_json(folder / "results.json") for folder in arguments.reports}
    for folder, report in reports.items():
        for measured in report["inputs"]:
            measured["errorImage"] = folder / measured["errorImage"]
    text = "".join(describe(reports, arguments.documentation / "images"))
    replace_part(arguments.documentation / "accuracy.md", "document_accuracy.py", text)


if __name__ == "__main__":
    main()
