// validate-gltf.js VALIDATOR FILE: prints what Khronos' glTF-Validator, in the folder VALIDATOR, says of a file; fails for errors and
// warnings.
const fs = require('fs');
const validator = require(process.argv[2]);

validator.validateBytes(new Uint8Array(fs.readFileSync(process.argv[3]))).then((report) => {
  console.log(JSON.stringify(report.issues));
  process.exitCode = report.issues.numErrors + report.issues.numWarnings > 0 ? 1 : 0;
});
