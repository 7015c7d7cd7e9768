// Plants that files describe, and exercises, in a real Chromium: each plant is opened, runs and
// moves; one exercise is solved. `node test/plants.mjs ADDRESS [PICTURES]`; PICTURES is a folder for
// pictures in both themes at two widths, on which axe-core looks as well.
import { readFile } from "node:fs/promises";
import assert from "node:assert/strict";
import { controls, open, watched } from "./browser.mjs";

const [, , address, pictures] = process.argv;
const AXE = await readFile(new URL("../node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const { browser, errors } = await open();

async function opened(fragment, options) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = watched(await context.newPage(), errors);
  await page.goto(`${address}#${fragment}`);
  const { button, tab, panel, mode } = controls(page);
  const axe = async (where) => {
    await page.evaluate(AXE);
    const { violations } = await page.evaluate(() => window.axe.run());
    const found = violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.html.slice(0, 200)}`);
    assert.deepEqual(found, [], where);
  };
  const close = () => context.close();
  return { page, button, tab, panel, mode, axe, close };
}

/** Waits until something in the drawing is elsewhere, or looks different. */
async function moves(page, title) {
  const drawing = page.getByRole("img", { name: title, exact: true });
  await drawing.waitFor();
  const look = () => drawing.evaluate((element) => element.innerHTML);
  const before = await look();
  for (let tries = 0; tries < 200; tries += 1) {
    if ((await look()) !== before) return;
    await page.waitForTimeout(50);
  }
  assert.fail(`${title} does not move`);
}

/** Holds a button of the plant for a moment. */
async function press(page, name) {
  const push = page.getByRole("button", { name: `press: ${name}`, exact: true });
  await push.focus();
  await page.keyboard.down(" ");
  await page.waitForTimeout(400);
  await page.keyboard.up(" ");
}

const PLANTS = [
  {
    example: "traffic_light",
    title: "Pedestrian crossing",
    act: (page) => press(page, "Somebody comes"),
    seen: /on foot: 1/,
  },
  {
    example: "conveyor",
    title: "Conveyor",
    act: (page) => page.getByRole("switch", { name: "Belt on", exact: true }).click(),
    seen: /pieces in boxes: [1-9]/,
  },
  {
    example: "garage_door",
    title: "Garage door",
    act: (page) => press(page, "Button"),
    seen: /height in mm: 2[.,]?200/,
  },
];

/** How fast each target goes: the virtual Uno as fast as it can. */
const TARGETS = { Simulator: "10", "Virtual Uno": "0" };
/** What an emulated chip may take on a computer with other work, in milliseconds. */
const CHIP_PATIENCE = { timeout: 300_000 };

for (const { example, title, act, seen } of PLANTS)
  for (const [target, speed] of Object.entries(TARGETS)) {
    const { page, button, tab, panel, mode, axe, close } = await opened(`example=${example}`);
    await page.getByRole("textbox", { name: `${example}.awl` }).waitFor();
    await page.getByRole("combobox", { name: "Target" }).selectOption({ label: target });
    await button("Run").click();
    await mode("RUN");
    await tab("Plant");
    await act(page);
    await moves(page, title);
    await page.getByRole("combobox", { name: "Speed" }).selectOption(speed);
    await panel("Plant").getByText(seen).first().waitFor(CHIP_PATIENCE);
    await axe(`${example}, ${target}`);
    await close();
    console.log(`${example}: it moves; ${target}`);
  }

// Something breaks: the door is at the bottom, and the program never hears of it.
{
  const { page, button, tab, panel, mode, close } = await opened("example=garage_door");
  await button("Run").click();
  await mode("RUN");
  await tab("Plant");
  const fault = page.getByRole("switch", { name: "Upper end switch stuck", exact: true });
  await fault.click();
  assert.equal(await fault.getAttribute("aria-checked"), "true");
  await press(page, "Button");
  await page.getByRole("combobox", { name: "Speed" }).selectOption("10");
  await panel("Plant").getByText("the motor has tripped").waitFor();
  // The file of the plant is edited: the drawing follows, and what is wrong is told.
  await page.getByRole("button", { name: "garage_door.plant", exact: true }).click();
  await page.getByRole("textbox", { name: "garage_door.plant" }).click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type('\ndraw text 20 40 "written here"\n');
  await panel("Plant").getByText("written here").waitFor();
  await page.keyboard.type("mvoe Door +1/s\n");
  await tab("Problems");
  await panel("Problems").getByText("E0600").waitFor();
  await close();
  console.log("a fault is switched, and a plant is edited");
}

// A fault of a plant with a picture of the page.
{
  const { page, button, tab, panel, mode, close } = await opened("example=station1");
  await tab("Plant");
  await page.getByRole("switch", { name: "Upper end switch stuck", exact: true }).click();
  await button("Run").click();
  await mode("RUN");
  await page.getByRole("combobox", { name: "Speed" }).selectOption("0");
  await panel("Plant").getByText("put on the platform").waitFor();
  await page.waitForTimeout(1000);
  assert.equal(await panel("Plant").getByText("pushed onto").count(), 0, "it never arrives");
  await close();
}

// An exercise: what is missing is told, solved it is remembered.
{
  const { page, button, tab, panel, axe, close } = await opened("");
  await tab("Exercises");
  await panel("Exercises").getByRole("button", { name: "A lamp with a switch" }).click();
  const editor = page.getByRole("textbox", { name: "lamp.awl" });
  await editor.waitFor();
  await button("Check").click();
  await panel("Exercises").getByText("1 of 2 are there").waitFor();
  await panel("Exercises").getByText("The lamp is on while the switch is on").waitFor();
  await panel("Exercises").getByText("expected Q0.0 = 1, got 0").waitFor();
  await axe("an exercise with something missing");
  await editor.click();
  await page.keyboard.press("Control+End");
  await page.keyboard.type("LD I0.0\n= Q0.0\n");
  await button("Check").click();
  await panel("Exercises").getByText("Solved: everything is there.").waitFor();
  await button("Choose another one").click();
  const row = panel("Exercises").getByRole("button", { name: /A lamp with a switch/ });
  await row.filter({ hasText: "solved" }).waitFor();
  await axe("the list of exercises");
  await page.reload();
  await tab("Exercises");
  await panel("Exercises").getByRole("heading", { name: "A lamp with a switch" }).waitFor();
  await editor.getByText("LD I0.0").waitFor();
  await close();
  console.log("an exercise is solved");
}

if (pictures)
  for (const colorScheme of ["light", "dark"])
    for (const width of [1024, 390]) {
      const viewport = { width, height: 844 };
      const shoot = async (fragment, shown, prepare) => {
        const { page, button, tab, mode, axe, close } = await opened(fragment, {
          colorScheme,
          viewport,
        });
        await tab(shown);
        if (prepare) {
          await button("Run").click();
          await mode("RUN");
          await page.getByRole("combobox", { name: "Speed" }).selectOption("10");
          await prepare(page);
          await page.waitForTimeout(1500);
        }
        const name = `${colorScheme}-${width}-${fragment.replace(/\W/g, "-")}`;
        const fullPage = width < 800;
        const drawing = page.locator(".panel:not([hidden]) svg.drawing").first();
        if (prepare) await drawing.evaluate((element) => element.scrollIntoView());
        await page.waitForTimeout(400);
        await page.screenshot({ path: `${pictures}/${name}.png`, fullPage });
        await axe(name);
        await close();
      };
      for (const { example, act } of PLANTS) await shoot(`example=${example}`, "Plant", act);
      await shoot("exercise=05_car_park", "Plant", (page) =>
        page.getByRole("switch", { name: "Cars come all the time" }).click(),
      );
      await shoot("exercise=03_fan", "Plant", (page) => press(page, "green button"));
      await shoot("exercise=01_lamp", "Exercises");
      await shoot("exercise=02_two_switches", "Plant");
      await shoot("exercise=04_stairwell", "Plant", (page) => press(page, "button"));
    }

assert.deepEqual(errors, []);
await browser.close();
console.log("plants and exercises do what they should");
