import assert from 'node:assert/strict';
import {test} from 'node:test';

import {isTyped, keepsKey} from '../src/keys';

const slider = {tagName: 'INPUT', type: 'range'}, number = {tagName: 'INPUT', type: 'number'}, button = {tagName: 'BUTTON'};
const box = {tagName: 'INPUT', type: 'checkbox'}, body = {tagName: 'BODY'};

test('a slider keeps the arrows and lets the page have the rest', () => {
  for (const key of ['ArrowLeft', 'PageUp', 'Home']) assert.ok(keepsKey(slider, key), key);
  for (const key of ['1', 'h', ' ', 'Delete', '?']) assert.ok(!keepsKey(slider, key), key);
  assert.ok(!isTyped(slider));
});

test('a field keeps all keys, a button those that press it and go on from it, the page none', () => {
  for (const key of ['1', 'h', ' ', 'ArrowLeft']) {
    assert.ok(keepsKey(number, key), key);
    assert.ok(!keepsKey(body, key), key);
  }
  for (const one of [button, box, {tagName: 'DIV', role: 'tab'}]) {
    assert.deepEqual([' ', 'ArrowLeft', '1', 'h'].map((key) => keepsKey(one, key)), [true, true, false, false]);
    assert.ok(!isTyped(one));
  }
});
