// Evaluates designs by OpenSCAD's snapshot of 2025.07.18. Each line of the standard input is a job, a JSON
// object: `folder`, where the program is started, `files` by path, `copies` of this computer's files by path, `arguments` of the command line,
// `wanted`, a path that is read afterwards. Each job is answered by a line: `status`, `said` (the messages),
// `made` (the text of the wanted file, or null) and `ms` (what it took, its start left out). An instance
// of the program runs once; the next one is made while it is not needed yet.
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";

// The package is found where it is installed, not beside this file.
const { createOpenSCAD } = await import(process.argv[2]);

async function makeInstance() {
  const said = [];
  const openscad = await createOpenSCAD({
    print: (line) => said.push(line),
    printErr: (line) => said.push(line),
  });
  return { instance: openscad.getInstance(), said };
}

function answer({ instance, said }, job) {
  const folder = job.folder;
  instance.FS.mkdirTree(folder);
  instance.FS.chdir(folder);
  const write = (path, bytes) => {
    const whole = path.startsWith("/") ? path : `${folder}/${path}`;
    instance.FS.mkdirTree(whole.replace(/\/[^/]*$/, "") || "/");
    instance.FS.writeFile(whole, bytes);
  };
  for (const [path, text] of Object.entries(job.files)) write(path, text);
  for (const [path, source] of Object.entries(job.copies ?? {})) write(path, readFileSync(source));
  let status;
  const start = performance.now();
  try {
    status = instance.callMain(job.arguments);
  } catch (error) {
    status = String(error);
  }
  const ms = performance.now() - start;
  let made = null;
  try {
    made = instance.FS.readFile(job.wanted, { encoding: "utf8" });
  } catch {
    // The program has written none.
  }
  return { status, said: said.join("\n"), made, ms };
}

let next = makeInstance();
for await (const line of createInterface({ input: process.stdin })) {
  const ready = await next;
  const answered = answer(ready, JSON.parse(line));
  console.log(JSON.stringify(answered));
  next = makeInstance();
}
