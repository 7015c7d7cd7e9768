// A pretended core: enough answers to look at the page without the real one. Nothing in it is true
// of a PLC.
export default async function init() {}

const clean = (line) => line.replace(/\/\/.*/, "").trim();

export class Ide {
  files = new Map();
  main = null;
  mode = "OFFLINE";
  target = "simulator";
  forced = new Map();
  inputs = 0;
  analog = [0, 0, 0, 0, 0, 0];
  watch = [];
  view = { from: 0, to: 0 };
  scope = { signals: [], everyMs: 10 };
  plant = null;
  timeMs = 0;
  sampledMs = 0;
  lastTick = 0;
  toldMs = 0;
  speed = 1;
  out = [];

  request(json, now) {
    const wish = JSON.parse(json);
    const act = this[`do_${wish.do}`];
    if (act) act.call(this, wish, now);
    else this.say({ is: "refused", id: wish.id, message: `${wish.do} comes later` });
    return this.flush();
  }

  receive() {
    return "[]";
  }

  isBehind() {
    return false;
  }
  chipDueMs() {
    return 0;
  }

  tick(now) {
    const dt = now - this.lastTick;
    this.lastTick = now;
    if (this.mode === "RUN") this.timeMs += dt * (this.speed || 100);
    if (this.mode === "RUN") this.sample();
    if (now - this.toldMs > 100) {
      this.toldMs = now;
      this.tell();
    }
    return this.flush();
  }

  say(event) {
    this.out.push(event);
  }

  flush() {
    return JSON.stringify(this.out.splice(0));
  }

  reply(wish, answer) {
    this.say({ is: "answer", id: wish.id, answer });
  }

  // Files
  do_open({ files, main }) {
    this.files = new Map(files.map(({ name, text }) => [name, text]));
    this.main = main;
    this.check();
    this.status();
  }
  do_edit({ file, text }) {
    this.files.set(file, text);
    this.check();
  }
  do_remove({ file }) {
    this.files.delete(file);
    this.check();
  }
  do_rename({ file, to }) {
    this.files.set(to, this.files.get(file));
    this.files.delete(file);
    this.check();
  }
  do_choose({ main }) {
    this.main = main;
    this.check();
  }

  check() {
    const problems = [];
    for (const [file, text] of this.files) {
      let from = 0;
      for (const [index, line] of text.split("\n").entries()) {
        const found = /\b(TON\s+)(T5)\b/.exec(line);
        if (found && file.endsWith(".awl")) {
          const start = from + found.index + found[1].length;
          problems.push({
            file,
            code: "E0013",
            isError: true,
            from: start,
            to: start + 2,
            line: index + 1,
            column: found.index + found[1].length + 1,
            message: "T5 is a TONR number: TON needs another one",
            help: ["with 100 ms, TON can use T37-T63, T101-T255"],
            suggestion: "T37",
            related: [],
          });
        }
        from += line.length + 1;
      }
    }
    this.say({ is: "problems", problems });
    const text = this.files.get(this.main) ?? "";
    const lines = text.split("\n");
    const symbols = lines.map((line) => /^\/\/# symbol (\w+)\s+(\S+)/.exec(line)).filter(Boolean);
    const program = {
      file: this.main ?? "",
      instructions: lines.filter((line) => /^[A-Z=]/.test(clean(line)) && !/^NETW/.test(line))
        .length,
      bytes: text.length >> 2,
      bytesMax: 7680,
      data: 45,
      dataMax: 896,
      longestUs: 184.2,
      fitsUno: true,
      operands: [...symbols.map(([, name, address]) => [name, address]), ["I0.0", ""], ["MW3", ""]],
    };
    this.say({ is: "program", program: problems.length > 0 ? null : program });
  }

  // Questions
  do_complete(wish) {
    const text = this.files.get(wish.file).slice(0, wish.at);
    const word = /[\w]*$/.exec(text)[0];
    const from = wish.at - word.length;
    const one = (label, kind, detail, info) => {
      return { label, kind, detail, info, insert: label, holes: [], from };
    };
    this.reply(wish, [
      one(
        "TON",
        "instruction",
        "T, PT",
        "## TON\n\nOn-delay timer. *Box.*\n\n| operand | kind |\n|---|---|\n| `T37` | timer |",
      ),
      one("TOF", "instruction", "T, PT", "Off-delay timer."),
      one("Height", "symbol", "MW3", "the reading of the piece"),
    ]);
  }
  do_hover(wish) {
    const text = this.files.get(wish.file);
    const from = text.slice(0, wish.at).search(/\w*$/);
    const to = wish.at + /^\w*/.exec(text.slice(wish.at))[0].length;
    const answer = {
      from,
      to,
      text: `**${text.slice(from, to)}**\n\nSomething *about* it, with \`code\`.`,
    };
    this.reply(wish, from < to ? answer : null);
  }
  word(wish) {
    const text = this.files.get(wish.file);
    const from = text.slice(0, wish.at).search(/\w*$/);
    return text.slice(from, wish.at) + /^\w*/.exec(text.slice(wish.at))[0];
  }
  uses(wish) {
    const word = this.word(wish);
    return [...this.files].flatMap(([file, text]) =>
      [...text.matchAll(new RegExp(`\\b${word}\\b`, "g"))].map(({ index }) => ({
        file,
        from: index,
        to: index + word.length,
      })),
    );
  }
  do_definition(wish) {
    this.reply(wish, this.uses(wish)[0] ?? null);
  }
  do_references(wish) {
    this.reply(wish, this.uses(wish));
  }
  do_renameSymbol(wish) {
    this.reply(
      wish,
      this.uses(wish).map((place) => ({ ...place, text: wish.to })),
    );
  }
  do_format(wish) {
    this.reply(wish, []);
  }
  do_outline(wish) {
    let from = 0;
    const items = [];
    for (const [index, line] of this.files.get(wish.file).split("\n").entries()) {
      const found = /^NETWORK (.*)/.exec(line);
      if (found) items.push({ name: found[1], kind: "network", line: index + 1, from });
      from += line.length + 1;
    }
    this.reply(wish, items);
  }
  do_simulate(wish) {
    const { signals, forMs, scanMs } = wish;
    const times = Array.from({ length: Math.floor(forMs / scanMs) }, (_, scan) => scan * scanMs);
    const columns = signals.map((_, index) => times.map((time) => this.wave(index, time)));
    const figures = columns.map((column) => {
      const sum = column.reduce((sum, value) => sum + value, 0);
      return [
        column.reduce((a, b) => Math.min(a, b)),
        column.reduce((a, b) => Math.max(a, b)),
        sum / column.length,
      ];
    });
    const rows = times.map((time, scan) =>
      [time, scan, ...columns.map((column) => column[scan])].join(),
    );
    const csv = [["time_ms", "scan", ...signals].join(), ...rows].join("\n");
    this.reply(wish, { names: signals, times, columns, figures, csv, vcd: "$end", plant: null });
  }
  do_test(wish) {
    const passed = !/bad/.test(wish.file);
    const failures = [[3, "at 2.9s expected Q0.0 = 1, got 0; it became 1 at 3s"]];
    this.reply(wish, {
      goal: null,
      passed,
      scans: 40000,
      met: 48,
      failures: passed ? [] : failures,
      plant: null,
    });
  }

  // Control
  do_target(wish) {
    if (wish.kind !== "simulator")
      this.say({
        is: "refused",
        id: wish.id,
        message: "This target comes later: use the Simulator",
      });
    this.status();
  }
  do_connect() {
    this.mode = "STOP";
    this.status();
  }
  do_disconnect() {
    this.mode = "OFFLINE";
    this.status();
  }
  do_download() {
    this.do_connect();
  }
  do_run() {
    this.mode = "RUN";
    this.status();
  }
  do_stop() {
    this.mode = "STOP";
    this.status();
  }
  do_pause({ on }) {
    this.mode = on ? "PAUSE" : "RUN";
    this.status();
  }
  do_singleScan() {
    this.mode = "PAUSE";
    this.timeMs += 1;
    this.status();
  }
  do_reset() {
    this.timeMs = 0;
    this.mode = "STOP";
    this.status();
  }
  do_speed({ factor }) {
    this.speed = factor;
  }
  do_aboutPlant(wish) {
    const title = ["", "", ""];
    const words = ["Sensor stuck", "Sensor klemmt", "Sensor bloqueado"];
    const controls = [{ name: "Stuck", words, kind: "fault", low: 0, high: 1, value: 0 }];
    this.reply(wish, { title, digital: 0x1f, analog: 1, controls, shapes: [] });
  }

  do_handle() {}

  do_plant({ spec }) {
    this.plant = spec;
  }
  do_drive({ operand, value }) {
    const number = Number(operand.slice(-1));
    if (operand.startsWith("Ain")) this.analog[number] = value;
    else this.inputs = (this.inputs & ~(1 << number)) | (value << number);
  }
  do_set() {}
  do_force({ operand, value }) {
    this.forced.set(operand, value);
    this.tellForced();
  }
  do_unforce({ operand }) {
    if (operand === null) this.forced.clear();
    else this.forced.delete(operand);
    this.tellForced();
  }
  do_watch({ operands }) {
    this.watch = operands;
  }
  do_view({ from, to }) {
    this.view = { from, to };
  }
  do_scope({ signals, everyMs }) {
    this.scope = { signals, everyMs };
    this.sampledMs = this.timeMs;
  }

  status() {
    const isOn = this.mode !== "OFFLINE";
    this.say({
      is: "status",
      status: {
        target: this.target,
        mode: this.mode,
        agreement: isOn ? "same" : "none",
        scans: Math.floor(this.timeMs),
        timeMs: Math.floor(this.timeMs),
        pace: null,
        scanUs: isOn ? [11.2, 12.4, 48.9] : null,
        fault: null,
        faultAt: null,
        lost: null,
      },
    });
  }

  tellForced() {
    const values = [...this.forced].map(([name]) => this.value(name, 0));
    this.say({ is: "forced", values });
  }

  wave(index, time) {
    if (index === 1) return Math.round(500 + 400 * Math.sin(time / 1500));
    return Math.floor(time / (400 * (index + 1))) % 2;
  }

  value(name, index) {
    const isWord = /W|Height|\.cv|Ain/.test(name);
    const forced = this.forced.has(name);
    const number = forced
      ? Number(this.forced.get(name))
      : this.wave(isWord ? 1 : index, this.timeMs);
    const problem = /^\?/.test(name) ? "no such operand" : null;
    const form = isWord ? "word" : "bit";
    return {
      name,
      text: String(number),
      number,
      form,
      forced,
      canForce: !/^T/.test(name),
      problem,
    };
  }

  tell() {
    if (this.mode === "OFFLINE") return;
    this.status();
    const outputs = Math.floor(this.timeMs / 500) & 0x3f;
    this.say({ is: "pins", inputs: this.inputs, outputs, analog: this.analog, pwm: [] });
    if (this.watch.length > 0)
      this.say({ is: "watched", values: this.watch.map((name, index) => this.value(name, index)) });
    if (this.view.from > 0) this.live();
    if (this.plant) this.tellPlant();
  }

  live() {
    const lines = [];
    const text = (this.files.get(this.main) ?? "").split("\n");
    for (let line = this.view.from; line <= Math.min(this.view.to, text.length); line += 1) {
      const [mnemonic, ...operands] = clean(text[line - 1]).split(/[\s,]+/);
      if (!mnemonic || mnemonic === "NETWORK") continue;
      const values = operands.filter((word) => /^[A-Z]/i.test(word));
      const flow = ["on", "off", "skipped"][(line + Math.floor(this.timeMs / 1000)) % 3];
      lines.push({ line, flow, values: values.map((name) => this.value(name, line % 5)) });
    }
    this.say({ is: "live", lines });
  }

  tellPlant() {
    const name = this.plant.split(" ")[0];
    const phase = (this.timeMs / 1000) % 10;
    const lift = Math.max(0, Math.min(1000, phase < 5 ? phase * 333 : (8 - phase) * 333));
    const state =
      name === "tank"
        ? [
            ["level", 500 + 400 * Math.sin(this.timeMs / 3000)],
            ["pump", phase < 5 ? 1 : 0],
            ["outlet", 1],
            ["overflow", 950],
          ]
        : [
            ["lift", lift],
            ["piston", phase > 4 && phase < 5 ? 800 : 0],
            ["sensor", phase > 3 && phase < 3.5 ? 1000 : 0],
            ["holder", phase > 4 ? 1000 : 0],
            ["piece", phase < 5 ? 207 : 0],
            ["ramp2", phase > 5 ? 207 : 0],
            ["slid", phase > 7 ? 300 : 0],
            ["fed", 7],
            ["good", 4],
            ["rejected", 2],
          ];
    const isNews = phase < 0.1;
    this.say({
      is: "plant",
      name,
      state,
      places: [],
      news: isNews ? ["2.5 s piece 1 (207) put on the platform"] : [],
    });
  }

  sample() {
    const { signals, everyMs } = this.scope;
    if (signals.length === 0) return;
    const times = [];
    while (this.sampledMs + everyMs <= this.timeMs) times.push((this.sampledMs += everyMs));
    if (times.length === 0) return;
    const columns = signals.map((_, index) => times.map((time) => this.wave(index, time)));
    this.say({ is: "samples", times, columns, lost: false });
  }
}
