// Runs tests/golden, compiled to WebAssembly: its lines of output, and its exit code.

/** In Node and in a worker alike: `create` is the factory of golden.js. */
export async function runGolden(create, wasm, table, args) {
  const lines = [];
  const module = await create({
    print: (line) => lines.push(line),
    printErr: (line) => lines.push(line),
    instantiateWasm: (imports, receive) => {
      WebAssembly.instantiate(wasm, imports).then(({ instance }) => receive(instance));
      return {};
    },
  });
  module.FS.writeFile("/digests.csv", table);
  let code;
  try {
    code = module.callMain(args);
  } catch (error) {
    if (error?.name !== "ExitStatus") throw error;
    code = error.status;
  }
  return { lines, code };
}
