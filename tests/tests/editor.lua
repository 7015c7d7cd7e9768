-- What a person does in Neovim, with the language server of uno200: a mistake is told and mended,
-- a word completed, explained, found, renamed. Writes what happened, a line each.
-- UNO200, FOLDER and REPORT are in the environment.

local folder, report = os.getenv("FOLDER"), {}
-- Long enough for a machine that has much else to do; what happens earlier ends the wait.
local PATIENCE = 60000

local function say(...) table.insert(report, table.concat({ ... }, " ")) end

local function finish(code)
  vim.fn.writefile(report, os.getenv("REPORT"))
  vim.cmd(code .. "cquit!")
end

local function await(what, condition)
  if not vim.wait(PATIENCE, condition, 5) then
    say("waited in vain for", what)
    finish(1)
  end
end

local function main()
  vim.cmd("edit " .. folder .. "/motor.awl")
  local buffer = vim.api.nvim_get_current_buf()
  vim.bo.filetype = "awl"
  local id = vim.lsp.start_client({
    name = "uno200",
    cmd = { os.getenv("UNO200"), "lsp" },
    root_dir = folder,
  })
  await("the server", function()
    local client = vim.lsp.get_client_by_id(id)
    return client and client.initialized
  end)
  vim.lsp.buf_attach_client(buffer, id)
  local client = vim.lsp.get_client_by_id(id)

  local function lines() return vim.api.nvim_buf_get_lines(buffer, 0, -1, false) end
  local function ask(method, more)
    local params = vim.lsp.util.make_position_params(0, client.offset_encoding)
    params = vim.tbl_extend("force", params, more or {})
    local answer = client.request_sync(method, params, PATIENCE, buffer)
    if not answer or answer.err then
      say(method, "failed:", vim.inspect(answer))
      finish(1)
    end
    return answer.result
  end
  local function go(line, column) vim.api.nvim_win_set_cursor(0, { line, column }) end

  -- A mistake, and what mends it.
  await("the diagnostic", function() return #vim.diagnostic.get(buffer) > 0 end)
  local wrong = vim.diagnostic.get(buffer)[1]
  say("diagnostic:", wrong.lnum + 1 .. ":" .. wrong.col + 1, wrong.message)
  go(wrong.lnum + 1, wrong.col)
  local range = vim.lsp.util.make_range_params(0, client.offset_encoding)
  local actions = ask("textDocument/codeAction", {
    range = range.range,
    context = { diagnostics = vim.lsp.diagnostic.get_line_diagnostics(buffer) },
  })
  say("action:", actions[1].title)
  vim.lsp.util.apply_workspace_edit(actions[1].edit, client.offset_encoding)
  say("mended:", lines()[wrong.lnum + 1])
  await("no diagnostic", function() return #vim.diagnostic.get(buffer) == 0 end)

  -- A word that is begun: an editor's completion takes the item that goes on so.
  vim.api.nvim_buf_set_lines(buffer, -1, -1, false, { "= La" })
  go(vim.api.nvim_buf_line_count(buffer), 4)
  vim.cmd("startinsert!")
  local items = ask("textDocument/completion", {
    position = { line = vim.api.nvim_buf_line_count(buffer) - 1, character = 4 },
  })
  for _, item in ipairs(items) do
    if item.label == "Lamp" then
      say("completion:", item.label, item.detail)
      vim.lsp.util.apply_text_edits({ item.textEdit }, buffer, client.offset_encoding)
    end
  end
  say("completed:", lines()[#lines()])
  vim.cmd("stopinsert")

  go(3, 0)
  say("hover:", (ask("textDocument/hover").contents.value:gsub("\n.*", "")))

  go(3, 4)
  local place = ask("textDocument/definition")[1]
  vim.lsp.util.jump_to_location(place, client.offset_encoding)
  say("definition:", vim.fn.expand("%:t"), vim.api.nvim_get_current_line())
  vim.cmd("buffer " .. buffer)

  go(3, 4)
  local edit = ask("textDocument/rename", { newName = "Begin" })
  vim.lsp.util.apply_workspace_edit(edit, client.offset_encoding)
  say("renamed:", lines()[3])
  for _, name in ipairs({ "motor.csv", "motor.scn" }) do
    local other = vim.fn.bufnr(folder .. "/" .. name)
    say("renamed in " .. name .. ":", vim.api.nvim_buf_get_lines(other, 0, 1, false)[1])
  end

  local edits = ask("textDocument/formatting", { options = { tabSize = 8, insertSpaces = true } })
  vim.lsp.util.apply_text_edits(edits, buffer, client.offset_encoding)
  say("formatted:", lines()[3])
  say("outline:", ask("textDocument/documentSymbol")[1].name)
  client.stop()
  await("the end of the server", function() return client.is_stopped() end)
  finish(0)
end

local ok, why = pcall(main)
if not ok then
  say("error:", tostring(why))
  finish(1)
end
