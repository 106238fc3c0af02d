// npm run bench: what the package weighs and how long it takes, as a stranger has it.
import { asStranger, node } from "../test/stranger.js";

process.exitCode = await asStranger(["bench", "test"], (folder) => node(folder, ["bench/measure.js"]));
