// Starts the language server of uno200 for programs, scenarios, plant files and symbol tables.

const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = async () => {
  const command = workspace.getConfiguration("uno200").get("path");
  const server = { command, args: ["lsp"] };
  client = new LanguageClient("uno200", "uno200", { run: server, debug: server }, {
    documentSelector: [
      { language: "awl" },
      { language: "st" },
      { language: "uno200-scenario" },
      { language: "uno200-plant" },
      // Of a table that belongs to no program the server says nothing.
      { scheme: "file", pattern: "**/*.csv" },
    ],
    synchronize: {
      fileEvents: workspace.createFileSystemWatcher("**/*.{awl,st,scn,plant,csv,txt}"),
    },
  });
  await client.start();
};

exports.deactivate = () => client?.stop();
