// One pair a line in, its frames a line out: node flubber.mjs FOLDER-OF-THE-PACKAGE
//
// In: {"source": [[x, y], …], "target": …, "times": […], "maxSegmentLength": …}
// Out: [[[x, y], …], …], one ring for each time.
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { createInterface } from "node:readline";

const require = createRequire(resolve(process.argv[2], "package.json"));
const { interpolate } = require("flubber");

for await (const line of createInterface({ input: process.stdin })) {
  const { source, target, times, maxSegmentLength } = JSON.parse(line);
  const frame = interpolate(source, target, { maxSegmentLength, string: false });
  console.log(JSON.stringify(times.map((t) => frame(t))));
}
